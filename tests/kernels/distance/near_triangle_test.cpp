// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A quick no against the distances of all interface triangles.
#include "kernels/distance/near_triangle.h"

#include <gtest/gtest.h>

#include "kernels/distance/interface_fan.h"
#include "tests/kernels/distance/random_points.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

using audit::test::below;
using audit::test::random_volume_of;
using audit::test::VolumeKind;

/// The least distance to a triangle of these labels at v without those two corners.
double least_distance(const TetMesh& mesh, LocalVertex v, const std::array<LocalVertex, 2>& without,
                      const NearTriangle::Wanted& wanted) {
  InterfaceFan fan;
  std::vector<FanTriangle> triangles;
  fan.collect(mesh, v, triangles);
  double least = 1e300;
  for (const FanTriangle& t : triangles) {
    if (t.low != wanted.low || t.high != wanted.high) continue;
    const auto is_left_out = [&](LocalVertex w) { return w == t.a || w == t.b; };
    if (is_left_out(without[0]) || is_left_out(without[1])) continue;
    const DistanceTriangle shape({in_voxels(mesh.position(v)), in_voxels(mesh.position(t.a)),
                                  in_voxels(mesh.position(t.b))});
    least = std::min(least, std::sqrt(shape.squared_distance(wanted.point)));
  }
  return least;
}

TEST(NearTriangle, SaysNoOnlyAndAlwaysWhereAllAreFarther) {
  std::mt19937 random(733);
  NearTriangle near;
  int yes = 0, no = 0;
  for (std::uint32_t i = 0; i < 60 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const TetMesh mesh = dense_mesh(random_volume_of(random, kind, {4, 4, 4}, 2 + i % 4));
    const auto vertex = [&] {
      return static_cast<LocalVertex>(
          below(random, static_cast<std::uint32_t>(mesh.vertex_count())));
    };
    for (int k = 0; k < 300; ++k) {
      const std::array<LocalVertex, 2> without{vertex(), vertex()};
      std::vector<LocalVertex> vertices;
      for (int n = 0; n < 6; ++n) {
        const LocalVertex v = vertex();
        if (v != without[0] && v != without[1] && mesh.is_free(v)) vertices.push_back(v);
      }
      const Label low = below(random, 3);
      const NearTriangle::Wanted wanted{random_point(random), 0.1 + 0.01 * below(random, 150), low,
                                        low + 1 + below(random, 2)};
      double least = 1e300;
      for (const LocalVertex v : vertices) {
        least = std::min(least, least_distance(mesh, v, without, wanted));
      }
      const bool is_near = near.may_be_at(mesh, vertices, without, wanted);
      EXPECT_EQ(is_near, least <= wanted.limit) << least << " of " << wanted.limit;
      ++(is_near ? yes : no);
    }
  }
  EXPECT_GT(yes, 500);
  EXPECT_GT(no, 500);
}

}  // namespace
}  // namespace mw::test
