// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 4 end to end: no label's boundary ends farther from the input's than the bound.
#include <gtest/gtest.h>

#include "kernels/audit/distance/distance.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/core/layers.h"
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

using audit::test::below;
using audit::test::random_volume_of;
using audit::test::VolumeKind;
using test::random_trial;
using test::run_in_memory;
using test::small_mesh;
using test::Trial;

double measured(const Trial& trial) {
  const auto mesh = small_mesh(run_in_memory(trial));
  const Index3 layers =
      trial.settings.surface == Surface::kSmooth ? layers_of(trial.frame.spacing) : Index3{1, 1, 1};
  const audit::LayeredLabels lattice = layered_labels(trial.volume.view(), layers);
  const auto report = measure_distance(lattice.view(), trial.volume.label_count, mesh.view(),
                                       layered_frame(trial.frame, layers));
  EXPECT_TRUE(report.is_finite());
  return report.max_voxels;
}

TEST(Promise4Distance, HoldsInBothDirectionsForEveryLabel) {
  std::mt19937 random(431);
  constexpr std::array<double, 4> kBounds{0.8, 1.0, 1.5, 2.5};
  for (int i = 0; i < 250 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
    const Index3 shape{6 + below(random, 12), 6 + below(random, 9), 6 + below(random, 6)};
    Trial trial = random_trial(random, random_volume_of(random, kind, shape, 2 + below(random, 4)));
    if (i % 4 == 0) {
      trial.frame.spacing = {1.0, 1.0, 3.0};
      trial.settings.surface = Surface::kSmooth;
    }
    if (i % 8 == 0) {
      trial.settings.surface = Surface::kVoxel;
      trial.settings.quality_floor = 0.1;
    }
    trial.settings.max_distance = kBounds[below(random, 4)];
    trial.settings.edge_variance.reset();
    SCOPED_TRACE(trial.text());
    EXPECT_LE(measured(trial), *trial.settings.max_distance);
  }
}

/// Without a bound the same kind of volume drifts farther, so the bound is what holds it.
TEST(Promise4Distance, IsNotKeptByChance) {
  std::mt19937 random(432);
  double farthest = 0.0;
  for (int i = 0; i < 20; ++i) {
    Trial trial =
        random_trial(random, random_volume_of(random, VolumeKind::kBlobs, {18, 14, 12}, 3));
    trial.settings.max_distance.reset();
    trial.settings.edge_variance.reset();
    trial.settings.target_reduction.reset();
    farthest = std::max(farthest, measured(trial));
  }
  EXPECT_GT(farthest, 2.5);
}

}  // namespace
}  // namespace mw::engine
