// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels in a mirror, or turned, are told from labels that are only roughly where they should be.
#include "kernels/audit/partition/placement.h"

#include <gtest/gtest.h>

#include "tests/oracle/small_volumes.h"

namespace mw::audit {
namespace {

using test::five_tet_mesh;
using test::random_volume;
using test::SmallMesh;
using test::SmallVolume;
using test::volume_from;

PlaceTally of_volume(const SmallVolume& v) {
  return places_of_voxels({{0, 0, 0}, v.shape}, v.labels, v.label_count, v.shape);
}

PlaceTally of_mesh(const SmallVolume& v, const SmallMesh& mesh, const Frame& frame) {
  return places_of_mesh({.mesh = mesh.view()}, v.label_count, frame, v.shape);
}

TEST(Placement, OfVoxelsAndOfTheirTetsIsTheSame) {
  std::mt19937 random(5);
  const Frame frame{{0.5, 2, 3}, {-4, 10, 0.25}};
  for (int i = 0; i < 50; ++i) {
    const SmallVolume v = random_volume(random);
    const PlaceTally voxels = of_volume(v);
    const PlaceTally tets = of_mesh(v, five_tet_mesh(v, frame), frame);
    for (Label l = 0; l < v.label_count; ++l) {
      EXPECT_NEAR(voxels.volumes[l], tets.volumes[l], 1e-9);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(voxels.moments[l][k], tets.moments[l][k], 1e-9);
      }
    }
    EXPECT_TRUE(judge_places(voxels, tets, v.shape).passed);
  }
}

TEST(Placement, FailsInEachMirrorAndTurn) {
  const SmallVolume v = volume_from({10, 10, 10}, 3, [](auto x, auto y, auto z) {
    return x < 2 && y < 6 && z < 2 ? 1 : x > 4 && y > 6 ? 2 : 0;
  });
  const auto check = [&](auto place) {
    SmallMesh mesh = five_tet_mesh(v);
    for (Position& p : mesh.vertices) p = place(p);
    return judge_places(of_volume(v), of_mesh(v, mesh, {}), v.shape);
  };
  EXPECT_TRUE(check([](const Position& p) { return p; }).passed);
  EXPECT_FALSE(check([](const Position& p) { return Position{10 - p[0], p[1], p[2]}; }).passed);
  EXPECT_FALSE(check([](const Position& p) { return Position{p[0], p[1], 10 - p[2]}; }).passed);
  EXPECT_FALSE(check([](const Position& p) {
                 return Position{10 - p[0], 10 - p[1], p[2]};
               }).passed);
  EXPECT_FALSE(check([](const Position& p) { return Position{p[1], p[0], p[2]}; }).passed);
  EXPECT_FALSE(check([](const Position& p) { return Position{p[2], p[0], p[1]}; }).passed);
  // Rough, but no mirror image.
  EXPECT_TRUE(check([](const Position& p) { return Position{p[0] + 2, p[1], p[2] - 2}; }).passed);
}

/// What looks the same in a mirror is none, and labels that one side lacks are not looked at.
TEST(Placement, PassesWhatIsSymmetric) {
  const SmallVolume v = volume_from({8, 6, 4}, 2, [](auto x, auto, auto) { return x < 4 ? 0 : 1; });
  SmallMesh mesh = five_tet_mesh(v);
  for (Position& p : mesh.vertices) p[1] = 6 - p[1];
  EXPECT_TRUE(judge_places(of_volume(v), of_mesh(v, mesh, {}), v.shape).passed);
  for (Position& p : mesh.vertices) p[0] = 8 - p[0];
  EXPECT_FALSE(judge_places(of_volume(v), of_mesh(v, mesh, {}), v.shape).passed);
  EXPECT_TRUE(judge_places(of_volume(v), PlaceTally(2), v.shape).passed);
}

}  // namespace
}  // namespace mw::audit
