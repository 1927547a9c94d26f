// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where vertices go, by solving for circumcentres; and who may not move.
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "kernels/odt/odt_sweep.h"
#include "kernels/odt/window_plc.h"
#include "kernels/quality/mesh_quality.h"
#include "tests/kernels/odt/window_meshes.h"

namespace mw::test {
namespace {

/// From the first corner of a tet to its circumcentre: as far from it as from the other three.
Vec3 circumcentre(const TetEdges& e) {
  Eigen::Matrix3d m;
  m << e.a.transpose(), e.b.transpose(), e.c.transpose();
  return m.inverse() * (0.5 * Vec3(e.a.squaredNorm(), e.b.squaredNorm(), e.c.squaredNorm()));
}

TEST(OdtSweep, GoesToTheMeanOfCircumcentres) {
  std::mt19937 random(1241);
  int whole_steps = 0;
  for (int i = 0; i < 40; ++i) {
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 2.0, 1.0});
    // The one corner inside 2^3 voxels.
    TetMesh mesh = dense_mesh(volume_from({2, 2, 2}, 1, [](auto, auto, auto) { return 0; }));
    disturb(mesh, random);
    constexpr LocalVertex kCentre = 13;
    Vec3 sum = Vec3::Zero();
    double volume = 0.0;
    for (const LocalTet& t : mesh.tets()) {
      if (!has(t, kCentre)) continue;
      const auto& v = t.vertices;
      const TetEdges e = tet_edges(metric, mesh.position(v[0]), mesh.position(v[1]),
                                   mesh.position(v[2]), mesh.position(v[3]));
      const auto weight = static_cast<double>(volume6_of(mesh, t));
      sum +=
          weight * (metric.vector(mesh.position(kCentre), mesh.position(v[0])) + circumcentre(e));
      volume += weight;
    }
    const Point start = mesh.position(kCentre);
    const Point expected = metric.moved(start, sum / volume);
    EXPECT_LE(odt_sweep(mesh, metric, 0.0), 1U);
    const Point end = mesh.position(kCentre);
    const auto near = [](std::int32_t a, std::int32_t b) { return std::abs(a - b) <= 1; };
    whole_steps += near(end.x, expected.x) && near(end.y, expected.y) && near(end.z, expected.z);
  }
  EXPECT_GE(whole_steps, 36) << "the step is halved only where tets would turn over";
}

TEST(OdtSweep, MovesInnerFreeVerticesOnly) {
  std::mt19937 random(1242);
  std::uint64_t moves = 0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    WindowCase window = random_window(random);
    const TetMesh before = window.mesh;
    const double floor = i % 2 == 0 ? 0.0 : 0.3;
    const std::uint64_t moved = odt_sweep(window.mesh, window.metric, floor);
    std::uint64_t elsewhere = 0;
    for (LocalVertex v = 0; v < before.vertex_count(); ++v) {
      const bool inner = before.is_free(v) && before.planes(v) == 0 && !before.on_interface(v);
      const Vec3 way = window.metric.vector(before.position(v), window.mesh.position(v));
      EXPECT_TRUE(inner || way.norm() == 0.0);
      elsewhere += way.norm() > 0.0 ? 1U : 0U;
      const double error = before.quadric(v).value(way);
      EXPECT_NEAR(window.mesh.quadric(v).c, error, 1e-9 * (1.0 + error));
    }
    EXPECT_EQ(elsewhere, moved);
    double worst = 1.0, worst_before = 1.0;
    for (const LocalTet& t : window.mesh.tets()) {
      ASSERT_GT(volume6_of(window.mesh, t), 0);
      worst = std::min(worst, radius_ratio(window.mesh, window.metric, t));
      worst_before = std::min(worst_before, radius_ratio(before, window.metric, t));
    }
    EXPECT_GE(worst, std::min(floor, worst_before) - 1e-12);
    moves += moved;
  }
  EXPECT_GT(moves, 200U);
}

// Facets and regions against brute force; points there and back.

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
