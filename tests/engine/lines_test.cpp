// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines of three labels end to end, beside circles that are known.
#include <map>
#include <numbers>
#include <set>

#include "tests/engine/mesh_of_body.h"

namespace mw::engine {
namespace {

using audit::Position;
using namespace test;

/// The turns of the line in which three labels meet, and how much a circle would turn there, summed
/// over the nodes that have two neighbours on it.
struct LineTurns {
  double turn = 0.0;   ///< radians
  double ideal = 0.0;  ///< radians
  double nodes = 0.0;
  double length = 0.0;
  double astray = 0.0;  ///< squared distances from the circle
  int forks = 0;        ///< nodes that have not two
};

/// A circle in space.
struct Circle {
  Vec3 centre;
  Vec3 normal;
  double radius = 0.0;

  [[nodiscard]] double squared_distance(const Vec3& p) const {
    const double height = (p - centre).dot(normal);
    const double across = (p - centre - height * normal).norm() - radius;
    return height * height + across * across;
  }
};

LineTurns line_turns(const SmallMesh& mesh, const Circle& circle) {
  std::map<std::array<std::uint64_t, 2>, std::set<Label>> around;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (mesh.tets[t][i] < mesh.tets[t][j]) {
          around[{mesh.tets[t][i], mesh.tets[t][j]}].insert(mesh.labels[t]);
        }
      }
    }
  }
  std::map<std::uint64_t, std::vector<std::uint64_t>> neighbours;
  for (const auto& [edge, labels] : around) {
    if (labels.size() < 3) continue;
    neighbours[edge[0]].push_back(edge[1]);
    neighbours[edge[1]].push_back(edge[0]);
  }
  const auto at = [&](std::uint64_t v) -> Vec3 {
    const Position& p = mesh.vertices[v];
    return {p[0], p[1], p[2]};
  };
  LineTurns out;
  for (const auto& [v, ends] : neighbours) {
    for (const std::uint64_t end : ends) out.length += 0.5 * (at(end) - at(v)).norm();
    if (ends.size() != 2) {
      ++out.forks;
      continue;
    }
    const Vec3 before = at(v) - at(ends[0]), after = at(ends[1]) - at(v);
    out.turn += std::acos(std::clamp(before.dot(after) / before.norm() / after.norm(), -1.0, 1.0));
    out.ideal += 0.5 * (before.norm() + after.norm()) / circle.radius;
    out.astray += circle.squared_distance(at(v));
    out.nodes += 1.0;
  }
  return out;
}

/// A ball that a plane cuts in two: its labels meet those outside in a circle.  Beside some of the
/// planes voxels touch along edges alone, where the line of the voxels forks.
TEST(SmoothSurface, LinesOfThreeLabelsAreSmoothWhereEdgesHaveSizes) {
  const Vec3 centre(21.7, 22.3, 21.9);
  const double circle = std::sqrt(16.0 * 16 - 3.0 * 3);
  const auto found_at = [&](const Vec3& way, double size) {
    const Vec3 normal = way.normalized();
    const SmallVolume halves = body(44, 3, [&](const Vec3& p) {
      if ((p - centre).norm() > 16) return 0U;
      return (p - centre).dot(normal) > 3 ? 2U : 1U;
    });
    MeshSettings settings;
    settings.sizes.rules.others = size;
    return line_turns(run(halves, settings).mesh, {centre + 3.0 * normal, normal, circle});
  };
  for (const auto& [size, most_astray] : {std::pair{2.0, 0.13}, {4.0, 0.17}}) {
    for (const Vec3& way : {Vec3(0.3, 0.5, 0.81), Vec3(0.67, -0.59, 0.44), Vec3(0.91, 0.35, 0.2),
                            Vec3(0.58, 0.58, 0.58)}) {
      const LineTurns found = found_at(way, size);
      EXPECT_EQ(found.forks, 0) << size;
      EXPECT_LT(found.turn, 1.2 * found.ideal) << size;
      EXPECT_NEAR(found.length, 2.0 * std::numbers::pi * circle, 0.01 * found.length) << size;
      // Not drawn to planes they would be up to 0.16 and 0.19 voxel astray.
      EXPECT_LT(std::sqrt(found.astray / found.nodes), most_astray) << size;
      // Edges are as long as was asked, and not the voxels' short ones between steps.
      EXPECT_LT(found.nodes, 1.2 * found.length / size) << size;
    }
  }
}

}  // namespace
}  // namespace mw::engine
