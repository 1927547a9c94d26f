// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 1 with --topology interfaces, end to end: meetings of labels and pairwise interfaces of
// whole runs on small volumes, by ranks of boundary matrices.
#include <gtest/gtest.h>

#include "tests/engine/memory_run.h"
#include "tests/oracle/cell_complex.h"

namespace mw::engine {
namespace {

using audit::test::below;
using audit::test::betti_of;
using audit::test::complex_of;
using audit::test::junctions_of;
using audit::test::random_volume_of;
using audit::test::VolumeKind;
using test::random_trial;
using test::run_in_memory;
using test::small_mesh;
using test::SmallMesh;
using test::SmallVolume;
using test::Trial;

/// Mostly windows of four voxels, so that there are many of them.
Trial interfaces_trial(std::mt19937& random, SmallVolume volume) {
  Trial trial = random_trial(random, std::move(volume));
  if (below(random, 4) != 0) trial.settings.window = 4;
  trial.settings.topology = KeptTopology::kInterfaces;
  return trial;
}

SmallVolume random_small(std::mt19937& random, std::uint32_t max, std::uint32_t labels) {
  const auto edge = [&] { return std::int64_t{1 + below(random, max)}; };
  const auto x = edge(), y = edge(), z = edge();
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  return random_volume_of(random, kind, {x, y, z}, 2 + below(random, labels - 1));
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
  EXPECT_GT(tally.changed_in_labels, 70) << "nothing could have failed";
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
