// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 1: every label keeps its Betti numbers.
#include <gtest/gtest.h>

#include "tests/promises/whole_runs.h"

namespace mw::engine {
namespace {

using namespace test;

TEST(Promise1Topology, HoldsByRanksOnTinyVolumes) {
  std::mt19937 random(101);
  std::size_t vertices = 0, start = 0;
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    Trial trial = random_trial(random, random_small(random, 1, 5, 8));
    if (i % 2 == 0) trial.settings.window = 4;
    vertices += expect_promises(trial, Counter::kRanks);
    start += static_cast<std::size_t>(corners(trial.volume.shape));
  }
  EXPECT_LT(vertices, start * 9 / 10) << "nothing was simplified, so nothing was tested";
}

TEST(Promise1Topology, HoldsOnSmallVolumesOfManyWindows) {
  std::mt19937 random(102);
  for (int i = 0; i < 1500 && !HasFailure(); ++i) {
    expect_promises(random_trial(random, random_small(random, 2, 9, 5)), Counter::kAudit);
  }
}

TEST(Promise1Topology, HoldsOnLargerVolumes) {
  std::mt19937 random(103);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    expect_promises(random_trial(random, random_small(random, 10, 24, 6)), Counter::kAudit);
  }
}

TEST(Promise1Topology, HoldsOnFlatAndThreadLikeVolumes) {
  std::mt19937 random(104);
  for (int i = 0; i < 1500 && !HasFailure(); ++i) {
    Index3 shape = random_shape(random, 1, 11);
    const std::uint32_t axis = below(random, 3);
    (axis == 0 ? shape.x : axis == 1 ? shape.y : shape.z) = 1;
    if (i % 3 == 0) (axis == 0 ? shape.y : axis == 1 ? shape.z : shape.x) = 1;
    const VolumeKind kind = random_kind(random);
    const std::uint32_t labels = 1 + below(random, 5);
    expect_promises(random_trial(random, random_volume_of(random, kind, shape, labels)),
                    Counter::kRanks);
  }
}

TEST(Promise1Topology, HoldsForNoiseOfManyLabels) {
  std::mt19937 random(105);
  for (int i = 0; i < 120 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 3, 8);
    const std::uint32_t labels = 9 + below(random, 60);
    expect_promises(
        random_trial(random, random_volume_of(random, VolumeKind::kNoise, shape, labels)),
        Counter::kAudit);
  }
}

/// One voxel of another label is kept as a ball wherever it lies: inside, on a block plane, on the
/// box's face, edge or corner.
TEST(Promise1Topology, KeepsASingleVoxelEverywhere) {
  const Index3 shape{5, 6, 7};
  std::mt19937 random(106);
  for (std::int64_t at = 0; at < shape.product() && !HasFailure(); ++at) {
    std::int64_t next = 0;
    const SmallVolume volume =
        volume_from(shape, 2, [&](auto, auto, auto) { return next++ == at ? 1 : 0; });
    expect_promises(random_trial(random, volume), Counter::kAudit);
  }
}

}  // namespace
}  // namespace mw::engine
