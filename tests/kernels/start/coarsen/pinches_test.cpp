// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pinches of voxels against maps of their faces, and coarsened labels that have no new ones.
#include "kernels/start/coarsen/pinches.h"

#include "tests/kernels/start/coarsen/coarse_volume.h"
#include "tests/oracle/pinches.h"

namespace mw::test {
namespace {

using audit::test::is_part_of;
using audit::test::Pinched;
using audit::test::PinchedByLabel;
using audit::test::pinches_of;

std::uint64_t corner_number(Index3 shape, Index3 at) {
  const Box3 corners{{0, 0, 0}, shape + Index3{1, 1, 1}};
  return static_cast<std::uint64_t>(corners.offset(at));
}

/// Each of the eight voxels at a corner as a cube of 2^3, so that the boundary goes on beyond.
TEST(PinchesAtCorner, AreThoseOfTheDefinitionForAllSets) {
  const Index3 shape{4, 4, 4}, middle{2, 2, 2};
  const std::uint64_t here = corner_number(shape, middle);
  int pinched = 0;
  for (unsigned voxels = 0; voxels < 256; ++voxels) {
    const SmallVolume volume = volume_from(shape, 2, [&](auto x, auto y, auto z) {
      return voxels >> (x / 2 + 2 * (y / 2) + 4 * (z / 2)) & 1U;
    });
    const Pinched all = pinches_of(volume.view())[1];
    unsigned expected = all.vertices.count(here) != 0 ? 1U : 0U;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::uint64_t lower = corner_number(shape, middle - axis_vector(axis));
      const std::uint64_t upper = corner_number(shape, middle + axis_vector(axis));
      if (all.edges.count({lower, here}) != 0) expected |= 2U << 2 * axis;
      if (all.edges.count({here, upper}) != 0) expected |= 4U << 2 * axis;
    }
    EXPECT_EQ(pinches_at_corner(static_cast<std::uint8_t>(voxels)), expected) << voxels;
    pinched += expected != 0 ? 1 : 0;
  }
  EXPECT_GT(pinched, 50);
  EXPECT_LT(pinched, 200);
}

/// A cube that becomes uniform in random labels.
TEST(AddsPinch, AgreesWithTheDefinition) {
  std::mt19937 random(1031);
  int adds = 0, pinched_before = 0;
  constexpr int kTries = 3000;
  for (int i = 0; i < kTries; ++i) {
    const std::uint32_t labels = 2 + below(random, 3);
    const VolumeKind kind = i % 2 == 0 ? VolumeKind::kBlobs : random_kind(random);
    SmallVolume volume = random_volume_of(random, kind, {4, 4, 4}, labels);
    const PinchedByLabel before = pinches_of(volume.view());
    CubeLabels cube{};
    const auto each_of_cube = [&](auto&& visit) {
      for (unsigned k = 0; k < 8; ++k)
        visit(cube[k], volume.labels[21 + (k & 1U) + 4 * (k >> 1 & 1U) + 16 * (k >> 2)]);
    };
    each_of_cube([](Label& in_cube, Label& here) { in_cube = here; });
    const Label to = cube[below(random, 8)];
    each_of_cube([to](Label&, Label& here) { here = to; });
    LabelsAroundCube now{};
    std::copy(volume.labels.begin(), volume.labels.end(), now.begin());
    const bool stays = is_part_of(pinches_of(volume.view()), before);
    ASSERT_EQ(adds_pinch(now, cube), !stays) << volume.text();
    adds += stays ? 0 : 1;
    pinched_before += is_part_of(before, {}) ? 0 : 1;
  }
  EXPECT_GT(adds, kTries / 10);
  EXPECT_LT(adds, kTries * 9 / 10);
  EXPECT_GT(pinched_before, kTries / 10);
}

TEST(Promise1Pinches, CoarsenedLabelsAreOnlyPinchedWhereTheInputIs) {
  std::mt19937 random(1032);
  int changed = 0, of_few = 0;
  for (int i = 0; i < 600 && !HasFailure(); ++i) {
    const VolumeKind kind = i % 3 == 0 ? random_kind(random) : VolumeKind::kBlobs;
    const SmallVolume volume =
        random_volume_of(random, kind, random_shape(random, 4, 12), 2 + below(random, 4));
    SCOPED_TRACE(volume.text());
    const SmallVolume coarse = coarsened(volume, 1.5);
    if (coarse.labels == volume.labels) continue;
    ++changed;
    const PinchedByLabel before = pinches_of(volume.view());
    EXPECT_TRUE(is_part_of(pinches_of(coarse.view()), before));
    of_few += is_part_of(before, {}) ? 1 : 0;
  }
  EXPECT_GT(changed, 200);
  EXPECT_GT(of_few, 20) << "volumes without a pinch";
}

/// What a cube loses depends on where it is.
TEST(Promise1Pinches, SolidCubesStayCleanWhereverTheyAre) {
  int changed = 0;
  for_each_index(Index3{2, 2, 2}, [&](Index3 at) {
    for (const std::int64_t edge : {3, 4, 5}) {
      const Box3 solid{at + Index3{2, 2, 2}, at + Index3{2 + edge, 2 + edge, 2 + edge}};
      for (const Label inside : {0U, 1U}) {
        const SmallVolume volume = volume_from({10, 10, 10}, 2, [&](auto x, auto y, auto z) {
          return solid.contains({x, y, z}) ? inside : 1 - inside;
        });
        const SmallVolume coarse = coarsened(volume, 1.5);
        EXPECT_TRUE(is_part_of(pinches_of(coarse.view()), {}));
        changed += coarse.labels != volume.labels ? 1 : 0;
      }
    }
  });
  EXPECT_GT(changed, 20);
}

}  // namespace
}  // namespace mw::test
