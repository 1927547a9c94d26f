// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 1: every label keeps its Betti numbers.
#include "tests/engine/memory_run.h"
#include "tests/oracle/cell_complex.h"
#include "tests/promises/whole_runs.h"

namespace mw::engine {
namespace {

using namespace test;
using namespace audit::test;

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

/// Cubes, two that touch by an edge or a corner, and balls, by default; what touches in voxels is
/// all that may be pinched.
TEST(Promise1Pinches, AreNotMadeOfSolidShapes) {
  std::size_t vertices = 0, start = 0;
  const auto mesh = [&](const SmallVolume& volume) {
    SCOPED_TRACE(volume.text());
    const Trial trial{.volume = volume};
    const SmallMesh out = small_mesh(run_in_memory(trial));
    expect_no_new_pinches(trial, out);
    vertices += out.vertices.size();
    start += static_cast<std::size_t>(corners(volume.shape));
  };
  for_each_index(Index3{2, 2, 2}, [&](Index3 at) {
    for (const std::int64_t edge : {3, 4, 5}) {
      const Index3 lo = at + Index3{2, 2, 2}, hi = lo + Index3{edge, edge, edge};
      const Box3 one{lo, hi};
      for (const Index3 side : {hi, Index3{hi.x, hi.y, lo.z}, Index3{hi.x + 9, hi.y, hi.z}}) {
        const Box3 other{side, side + Index3{edge, edge, edge}};
        mesh(volume_from({14, 14, 14}, 2, [&](auto x, auto y, auto z) {
          const Index3 v{x, y, z};
          return one.contains(v) || other.contains(v) ? 1 : 0;
        }));
      }
    }
  });
  std::mt19937 random(107);
  for (int i = 0; i < 20; ++i) {
    const auto place = [&] { return 7.0 + 0.1 * below(random, 10); };
    const double radius = 2.0 + 0.1 * below(random, 30), cx = place(), cy = place(), cz = place();
    mesh(volume_from({15, 15, 15}, 2, [&](auto x, auto y, auto z) {
      const auto square = [](double d) { return d * d; };
      const double dx = static_cast<double>(x) + 0.5 - cx, dy = static_cast<double>(y) + 0.5 - cy,
                   dz = static_cast<double>(z) + 0.5 - cz;
      return square(dx) + square(dy) + square(dz) < square(radius) ? 1 : 0;
    }));
  }
  EXPECT_LT(vertices, start / 4);
}

// Promise 1 with --topology interfaces, end to end: meetings of labels and pairwise interfaces of
// whole runs on small volumes, by ranks of boundary matrices.

/// Mostly windows of four voxels, so that there are many of them.
Trial interfaces_trial(std::mt19937& random, SmallVolume volume) {
  Trial trial = random_trial(random, std::move(volume));
  if (below(random, 4) != 0) trial.settings.window = 4;
  trial.settings.topology = KeptTopology::kInterfaces;
  return trial;
}

SmallVolume random_small(std::mt19937& random, std::uint32_t max, std::uint32_t labels) {
  const Index3 shape = random_shape(random, 1, max);
  const VolumeKind kind = random_kind(random);
  return random_volume_of(random, kind, shape, 2 + below(random, labels - 1));
}

struct Outcome {
  bool junctions_kept = false;
  std::size_t vertices = 0;
};

/// Runs the trial; labels must be kept in any case.
Outcome outcome_of(const Trial& trial) {
  SCOPED_TRACE(trial.text());
  const std::size_t n = trial.volume.label_count;
  const SmallMesh mesh = small_mesh(run_in_memory(trial));
  const auto input = complex_of(trial.volume.view(), n), output = complex_of(mesh.view(), n);
  EXPECT_TRUE(betti_of(output, n) == betti_of(input, n));
  return {junctions_of(output) == junctions_of(input), mesh.vertices.size()};
}

struct Tally {
  std::size_t vertices = 0;
  std::size_t corners = 0;
  int changed_in_labels = 0;  ///< runs that changed a place with KeptTopology::kLabels
};

void expect_junctions_kept(Trial trial, Tally& tally) {
  SCOPED_TRACE(trial.text());
  const Outcome kept = outcome_of(trial);
  EXPECT_TRUE(kept.junctions_kept);
  tally.vertices += kept.vertices;
  tally.corners += static_cast<std::size_t>((trial.volume.shape + Index3{1, 1, 1}).product());
  trial.settings.topology = KeptTopology::kLabels;
  tally.changed_in_labels += outcome_of(trial).junctions_kept ? 0 : 1;
}

TEST(Promise1Interfaces, HoldOnTinyVolumes) {
  std::mt19937 random(131);
  Tally tally;
  for (int i = 0; i < 700 && !HasFailure(); ++i) {
    expect_junctions_kept(interfaces_trial(random, random_small(random, 5, 6)), tally);
  }
  EXPECT_LT(tally.vertices, tally.corners * 9 / 10) << "nothing was simplified";
  EXPECT_GT(tally.changed_in_labels, 50) << "nothing could have failed";
}

TEST(Promise1Interfaces, HoldOnBlobsOfManyWindows) {
  std::mt19937 random(132);
  Tally tally;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const std::int64_t edge = 7 + below(random, 4);
    const std::uint32_t labels = 4 + below(random, 6);
    expect_junctions_kept(interfaces_trial(random, random_volume_of(random, VolumeKind::kBlobs,
                                                                    {edge, edge, 6}, labels)),
                          tally);
  }
  EXPECT_LT(tally.vertices, tally.corners / 2) << "little was simplified";
  EXPECT_GT(tally.changed_in_labels, 10) << "nothing could have failed";
}

}  // namespace
}  // namespace mw::engine
