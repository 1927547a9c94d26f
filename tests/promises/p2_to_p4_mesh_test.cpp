// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 2: the mesh is a partition of the box into positive tets.
#include "kernels/audit/distance/distance.h"
#include "kernels/audit/shape/volumes.h"
#include "kernels/core/lattice.h"
#include "tests/engine/memory_run.h"
#include "tests/promises/whole_runs.h"

namespace mw::engine {
namespace {

using namespace test;
using namespace audit::test;

TEST(Promise2Validity, OneLabelBecomesFewTetsOfTheExactBox) {
  std::mt19937 random(107);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 12);
    const SmallVolume volume = volume_from(shape, 1, [](auto, auto, auto) { return 0; });
    const std::size_t vertices = expect_promises(random_trial(random, volume), Counter::kAudit);
    EXPECT_GE(vertices, 8U);
  }
}

// Promise 3: no tet is below the quality floor.

constexpr std::array<Frame, 4> kThickFrames{{{{1, 1, 6}, {0, 0, 0}},
                                             {{8, 1, 1}, {5, 5, 5}},
                                             {{0.5, 4, 2}, {0, -1, 0}},
                                             {{1, 1.49, 1.51}, {0, 0, 1e6}}}};

TEST(Promise3Quality, FloorHoldsUnderStrongAnisotropy) {
  std::mt19937 random(108);
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    Trial trial = random_trial(random, random_small(random, 1, 7, 4));
    trial.frame = kThickFrames[below(random, 4)];
    trial.settings.surface = Surface::kSmooth;
    expect_promises(trial, Counter::kAudit);
  }
}

/// Layers leave voxels that are up to half as long again along one axis, so the start mesh may be
/// below a high floor; then the run is refused and names the one that it can keep, and keeps it.
TEST(Promise3Quality, FloorThatCannotBeKeptIsRefusedWithTheOneThatCan) {
  std::mt19937 random(112);
  int refused = 0;
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    Trial trial = random_trial(random, random_small(random, 1, 7, 4));
    trial.frame = kThickFrames.back();
    trial.settings.quality_floor = 0.3 + 0.1 * below(random, 3);
    try {
      expect_promises(trial, Counter::kAudit);
    } catch (const Error& e) {
      ++refused;
      EXPECT_EQ(e.kind(), ErrorKind::kUsage);
      const std::string message = e.what(), option = "; --quality-floor ";
      const std::size_t at = message.find(option);
      ASSERT_NE(at, message.npos) << message;
      const double asked = trial.settings.quality_floor;
      trial.settings.quality_floor = std::stod(message.substr(at + option.size()));
      EXPECT_LT(trial.settings.quality_floor, asked);
      expect_promises(trial, Counter::kAudit);
    }
  }
  EXPECT_GT(refused, 30);
}

/// What users get who set nothing.
TEST(Promise3Quality, DefaultFloorHoldsWithoutExceptionOnIsotropicVolumes) {
  std::mt19937 random(110);
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    Trial trial{.volume = random_small(random, 4, 18, 4), .settings = {}, .frame = {}};
    if (i % 3 == 0) trial.settings.start = StartMesh::kOctree;
    SCOPED_TRACE(trial.text());
    const SmallMesh mesh = small_mesh(run_in_memory(trial));
    EXPECT_GE(measure_quality(mesh.view()).radius_ratio_min,
              trial.settings.quality_floor - kRounding);
  }
}

/// The settings bind: a higher floor leaves a better worst tet than a lower one allows.
TEST(Promise3Quality, FloorIsWhatKeepsTheWorstTetUp) {
  std::mt19937 random(109);
  Trial trial{.volume = random_volume_of(random, VolumeKind::kBlobs, {12, 12, 12}, 3),
              .settings = {.window = 8,
                           .start = StartMesh::kDense,
                           .quality_floor = 0.0,
                           .optimizer = Optimizer::kNone},
              .frame = {}};
  const auto worst = [&] {
    return measure_quality(small_mesh(run_in_memory(trial)).view()).radius_ratio_min;
  };
  EXPECT_LT(worst(), 0.1);
  trial.settings.quality_floor = 0.3;
  EXPECT_GE(worst(), 0.3 - kRounding);
}

/// The paper has no floor; then inner vertices, too, go whatever shapes that leaves.
TEST(Promise3Quality, WithoutAFloorNothingIsAskedOfShapes) {
  std::mt19937 random(111);
  Trial trial{.volume = random_volume_of(random, VolumeKind::kBlobs, {16, 16, 16}, 2),
              .settings = {.window = 8,
                           .start = StartMesh::kDense,
                           .quality_floor = 0.0,
                           .optimizer = Optimizer::kNone},
              .frame = {}};
  const std::size_t without = run_in_memory(trial).vertices.size();
  trial.settings.quality_floor = 1e-9;
  EXPECT_LT(2 * without, run_in_memory(trial).vertices.size());
}

/// More inside labels is better tets, less is fewer; the floor and all labels stay.
TEST(Promise3Quality, InnerQualityTradesVerticesForShape) {
  std::mt19937 random(113);
  for (int i = 0; i < 5 && !HasFailure(); ++i) {
    Trial trial{.volume = random_volume_of(random, VolumeKind::kBlobs, {26, 24, 22}, 2),
                .settings = {.window = 16},
                .frame = {}};
    const auto quality = [&] {
      return measure_quality(small_mesh(run_in_memory(trial)).view()).radius_ratio_mean;
    };
    trial.settings.inner_quality = 0.25;
    const std::size_t few = expect_promises(trial, Counter::kAudit);
    const double low = quality();
    trial.settings.inner_quality = 0.55;
    EXPECT_GT(expect_promises(trial, Counter::kAudit), few);
    EXPECT_GT(quality(), low);
  }
}

// Promise 4 end to end: no label's boundary ends farther from the input's than the bound.

double measured(const Trial& trial) {
  const auto mesh = small_mesh(run_in_memory(trial));
  const Index3 layers = layers_of(trial.frame.spacing);
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
