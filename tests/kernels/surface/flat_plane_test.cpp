// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Planes of stars against all faces that their triangles carry.
#include "kernels/surface/flat_plane.h"

#include <set>

#include "kernels/simplify/simplify.h"
#include "kernels/surface/surface_star.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

/// Axes and places, in voxels, of the faces that the triangles at v carry.
std::set<std::pair<unsigned, double>> carried_planes(const DistanceGuard& guard, LocalVertex v,
                                                     std::span<const FanTriangle> fan) {
  std::set<std::pair<unsigned, double>> out;
  for (const FanTriangle& t : fan) {
    guard.for_each_piece(triangle_key(v, t.a, t.b), t.low, [&](const DistanceGuard::Piece& p) {
      out.emplace(p.axis, p.middle[static_cast<int>(p.axis)]);
    });
  }
  return out;
}

TEST(FlatPlane, IsTheOneOfAllFacesThatAreCarried) {
  std::mt19937 random(91);
  int flat = 0, stepped = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const auto kind = i % 4 == 0 ? VolumeKind::kNoise : VolumeKind::kBlobs;
    const SmallVolume volume = random_volume_of(random, kind, {7, 5, 6}, 2 + below(random, 3));
    GuardedMesh guarded(volume, 1.5);
    const TetMesh& mesh = guarded.mesh;
    if (i % 2 == 0) simplify(guarded.mesh, Metric(), {.quality_floor = 0.05}, &guarded.guard);
    SurfaceStar star;
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (!mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) continue;
      star.collect(mesh, Metric(), v);
      const auto planes = carried_planes(guarded.guard, v, star.fan());
      const std::optional<FlatPlane> plane = flat_plane(mesh, guarded.guard, v, star.fan());
      if (planes.size() > 1) {
        EXPECT_FALSE(plane);
        ++stepped;
      } else if (planes.size() == 1) {
        ASSERT_TRUE(plane);
        EXPECT_EQ(plane->axis, planes.begin()->first);
        EXPECT_EQ(plane->place, kUnitsPerVoxel * planes.begin()->second);
        ++flat;
      } else if (plane) {
        EXPECT_TRUE(has_ring(*plane, mesh, star.fan()));
        EXPECT_EQ(along(mesh.position(v), plane->axis), plane->place);
      }
    }
  }
  EXPECT_GT(flat, 50);
  EXPECT_GT(stepped, 500);
}

/// A step of one voxel in the middle of a floor: around it nothing is flat, far from it all is.
TEST(FlatPlane, HoldsWidelyOnlyAwayFromSteps) {
  SmallVolume volume{{12, 4, 6}, 2, {}};
  for_each_index(volume.shape,
                 [&](Index3 p) { volume.labels.push_back(p.z < (p.x < 6 ? 3 : 2) ? 0 : 1); });
  GuardedMesh guarded(volume, 1.5);
  SurfaceStar star;
  WideFlatPlane wide;
  int wide_ones = 0, narrow_ones = 0;
  for (LocalVertex v = 0; v < guarded.mesh.vertex_count(); ++v) {
    if (!guarded.mesh.is_free(v) || !guarded.mesh.on_interface(v)) continue;
    star.collect(guarded.mesh, Metric(), v);
    const auto plane = flat_plane(guarded.mesh, guarded.guard, v, star.fan());
    if (!plane) continue;
    const bool is_wide = wide.holds(*plane, guarded.mesh, guarded.guard, star.fan());
    const double from_step = std::abs(guarded.mesh.position(v).x / 1024.0 - 6.0);
    if (from_step <= 1.0) {
      EXPECT_FALSE(is_wide);
    }
    if (from_step >= 3.0) {
      EXPECT_TRUE(is_wide);
    }
    (is_wide ? wide_ones : narrow_ones) += 1;
  }
  EXPECT_GT(wide_ones, 10);
  EXPECT_GT(narrow_ones, 0);
}

}  // namespace
}  // namespace mw::test
