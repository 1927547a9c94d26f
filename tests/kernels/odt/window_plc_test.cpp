// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facets and regions against brute force; points there and back.
#include "kernels/odt/window_plc.h"

#include <Eigen/Geometry>

#include "tests/kernels/odt/window_meshes.h"

namespace mw::test {
namespace {

/// Number of classes of tets under "same label and a common triangle", by repeated relabelling.
std::size_t count_regions(const std::vector<LocalTet>& tets) {
  std::vector<std::size_t> group(tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i) group[i] = i;
  const auto touch = [&](const LocalTet& a, const LocalTet& b) {
    return a.label == b.label &&
           std::ranges::count_if(a.vertices, [&](LocalVertex v) { return has(b, v); }) == 3;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < tets.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (group[i] == group[j] || !touch(tets[i], tets[j])) continue;
        group[i] = group[j] = std::min(group[i], group[j]);
        changed = true;
      }
    }
  }
  return std::set(group.begin(), group.end()).size();
}

TEST(WindowPlc, HasHullAndInterfacesAsFacets) {
  std::mt19937 random(1201);
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const WindowCase window = random_window(random);
    const WindowPlc made = window_plc(window.mesh, window.metric);
    FaceLabels expected = borders(face_labels(window.mesh.tets(), positions(window.mesh)));
    EXPECT_EQ(made.plc.facets.size(), expected.size());
    for (const auto& facet : made.plc.facets) EXPECT_TRUE(expected.contains(facet));
    EXPECT_TRUE(tet_keys(made.content.tets) == tet_keys(window.mesh.tets()));
  }
}

TEST(WindowPlc, HasOneSeedInEachRegion) {
  std::mt19937 random(1202);
  for (int i = 0; i < 12 && !HasFailure(); ++i) {
    const WindowCase window = random_window(random);
    const WindowPlc made = window_plc(window.mesh, window.metric);
    ASSERT_EQ(made.plc.seeds.size(), count_regions(made.content.tets));
    ASSERT_EQ(made.content.labels.size(), made.plc.seeds.size());
    const auto edges = [&](std::size_t corner, const LocalTet& t, const PlcPoint& seed) {
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) {
        const PlcPoint& x = made.plc.points[t.vertices[k]];
        p[k] = k == corner ? Vec3(seed[0], seed[1], seed[2]) : Vec3(x[0], x[1], x[2]);
      }
      return (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
    };
    for (std::size_t r = 0; r < made.plc.seeds.size(); ++r) {
      int inside = 0;
      for (std::size_t t = 0; t < made.content.tets.size(); ++t) {
        bool in = true;
        for (std::size_t k = 0; k < 4; ++k) {
          in = in && edges(k, made.content.tets[t], made.plc.seeds[r]) > 0;
        }
        if (!in) continue;
        ++inside;
        EXPECT_EQ(made.content.regions[t], r);
        EXPECT_EQ(made.content.tets[t].label, made.content.labels[r]);
      }
      EXPECT_EQ(inside, 1);
    }
  }
}

TEST(WindowPlc, PointsComeBack) {
  std::mt19937 random(1203);
  for (int i = 0; i < 30; ++i) {
    const WindowCase window = random_window(random);
    const WindowPlc made = window_plc(window.mesh, window.metric);
    for (LocalVertex v = 0; v < window.mesh.vertex_count(); ++v) {
      EXPECT_EQ(made.frame.to_lattice(made.plc.points[v]), window.mesh.position(v));
    }
  }
  const PlcFrame frame({5, 6, 7}, Metric());
  EXPECT_EQ(frame.to_lattice({0.4, 1.6, 2.0}), (Point{5, 8, 9}));
  EXPECT_FALSE(frame.to_lattice({-1.0, 0.0, 0.0}));
  EXPECT_FALSE(frame.to_lattice({0.0, 3e9, 0.0}));
  EXPECT_FALSE(frame.to_lattice({0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace mw::test
