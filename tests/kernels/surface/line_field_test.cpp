// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines of three labels against a literal search, and places on curves that are known.
#include "kernels/surface/line_field.h"

#include <map>
#include <set>

#include "tests/kernels/surface/interface_triangles.h"
#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::below;

/// The far ends of the edges at v with three labels around them or more.
std::vector<LocalVertex> line_ends(const TetMesh& mesh, LocalVertex v) {
  std::map<LocalVertex, std::set<Label>> around;
  for (const LinkTriangle& t : mesh.star(v)) {
    for (const LocalVertex w : {t.a, t.b, t.c}) around[w].insert(t.label);
  }
  std::vector<LocalVertex> out;
  for (const auto& [w, labels] : around) {
    if (w != mesh.infinity() && labels.size() > 2) out.push_back(w);
  }
  return out;
}

TEST(LineField, IsWhereThreeLabelsMeet) {
  std::mt19937 random(1211);
  int known = 0, unknown = 0;
  for (std::uint32_t i = 0; i < 40 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const SmallVolume volume = random_volume_of(random, kind, {7, 6, 7}, 2 + below(random, 3));
    TetMesh mesh = i % 2 == 0 ? dense_mesh(volume) : dense_cutout(volume, {{1, 0, 1}, {6, 6, 6}});
    disturb(mesh, random);
    LineField lines;
    lines.find(mesh);
    const auto is_on_line = [&](LocalVertex v) {
      return mesh.is_free(v) && line_ends(mesh, v).size() == 2;
    };
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      bool expected = is_on_line(v);
      if (expected) {
        const std::vector<LocalVertex> ends = line_ends(mesh, v);
        expected = is_on_line(ends[0]) || is_on_line(ends[1]);
      }
      ASSERT_EQ(lines.place(mesh, Metric(), v).has_value(), expected) << v;
      (expected ? known : unknown) += 1;
    }
  }
  EXPECT_GT(known, 100);
  EXPECT_GT(unknown, 1000);
}

/// Three labels meet along y = z = 4 for all x.
TetMesh mesh_with_line() {
  return dense_mesh(volume_from({14, 8, 8}, 3, [](auto, auto y, auto z) {
    return y < 4 ? 0 : z < 4 ? 1 : 2;
  }));
}

/// The inner vertices of that line, by x.
std::map<std::int64_t, LocalVertex> line_vertices(const TetMesh& mesh) {
  std::map<std::int64_t, LocalVertex> out;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    const Point p = mesh.position(v);
    const std::int32_t middle = 4 * kUnitsPerVoxel;
    if (p.y == middle && p.z == middle && mesh.planes(v) == 0) out[p.x / kUnitsPerVoxel] = v;
  }
  return out;
}

Vec3 across(const LinePlace& found) {
  return found.place - found.direction.dot(found.place) * found.direction;
}

TEST(LineField, KeepsLinesOfEvenCurvature) {
  const Metric metric({1.0, 1.0, 1.5});
  TetMesh mesh = mesh_with_line();
  const std::map<std::int64_t, LocalVertex> line = line_vertices(mesh);
  ASSERT_EQ(line.size(), 13U);
  const auto bulge = [](std::int64_t x) {
    return 0.3 - 0.008 * static_cast<double>((x - 7) * (x - 7));
  };
  for (const auto& [x, v] : line) {
    mesh.move(v, metric.moved(mesh.position(v), {0.0, bulge(x), -bulge(x)}), mesh.quadric(v));
  }
  LineField lines;
  lines.find(mesh);
  // The ends of the line, on the box, stay where they are.
  for (std::int64_t x = 3; x <= 11; ++x) {
    const auto found = lines.place(mesh, metric, line.at(x));
    ASSERT_TRUE(found) << x;
    EXPECT_LT(across(*found).norm(), 0.03) << x;
    EXPECT_NEAR(found->edge, 1.0, 0.05);
  }
}

/// Steps of two edges, as voxels make them, are longer than the four nearest vertices tell.  Steps
/// of two voxels are a shape of the line.
TEST(LineField, TakesOutTheStepsOfVoxels) {
  const auto with_steps = [](double height) {
    TetMesh mesh = mesh_with_line();
    const std::map<std::int64_t, LocalVertex> line = line_vertices(mesh);
    for (const auto& [x, v] : line) {
      const double side = x / 2 % 2 == 0 ? -height : height;
      mesh.move(v, Metric().moved(mesh.position(v), {0.0, side, 0.0}), mesh.quadric(v));
    }
    LineField lines;
    lines.find(mesh);
    return *lines.place(mesh, Metric(), line.at(7));
  };
  const LinePlace small = with_steps(0.15), large = with_steps(1.0);
  EXPECT_NEAR(small.place[1], -0.15, 0.08);
  EXPECT_GT(small.share, 1.0);
  EXPECT_EQ(large.share, 1.0);
}

TEST(LineField, BringsAVertexBackOnTheLine) {
  TetMesh mesh = mesh_with_line();
  const std::map<std::int64_t, LocalVertex> line = line_vertices(mesh);
  const LocalVertex v = line.at(7);
  const Vec3 way(0.1, 0.2, -0.15);
  mesh.move(v, Metric().moved(mesh.position(v), way), mesh.quadric(v));
  LineField lines;
  lines.find(mesh);
  const auto found = lines.place(mesh, Metric(), v);
  ASSERT_TRUE(found);
  EXPECT_LT((across(*found) - Vec3(0.0, -0.2, 0.15)).norm(), 0.002);
  EXPECT_NEAR(std::abs(found->direction[0]), 1.0, 1e-12);
}

}  // namespace
}  // namespace mw::test
