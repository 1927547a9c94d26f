// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promises 1 to 3 end to end: topology, validity and quality of whole runs on small volumes.
#include <gtest/gtest.h>

#include "kernels/audit/betti.h"
#include "kernels/audit/quality.h"
#include "kernels/audit/validity.h"
#include "tests/engine/memory_run.h"
#include "tests/oracle/cell_complex.h"

namespace mw::engine {
namespace {

using audit::RegionBetti;
using audit::test::below;
using audit::test::betti_of;
using audit::test::complex_of;
using audit::test::random_volume_of;
using audit::test::volume_from;
using audit::test::VolumeKind;
using test::Frame;
using test::random_trial;
using test::run_in_memory;
using test::small_mesh;
using test::SmallMesh;
using test::SmallVolume;
using test::Trial;

constexpr double kRounding = 1e-9;

/// Who counts Betti numbers: ranks of boundary matrices, or the faster audit (itself tested so).
enum class Counter { kRanks, kAudit };

void expect_same_topology(const SmallVolume& volume, const SmallMesh& mesh, Counter counter) {
  const std::size_t n = volume.label_count;
  const bool ranks = counter == Counter::kRanks;
  const std::vector<RegionBetti> expected =
      ranks ? betti_of(complex_of(volume.view(), n), n) : voxel_betti(volume.view(), n);
  const std::vector<RegionBetti> actual =
      ranks ? betti_of(complex_of(mesh.view(), n), n) : mesh_betti(mesh.view(), n);
  for (std::size_t label = 0; label <= n; ++label) {
    EXPECT_TRUE(actual[label] == expected[label]) << "label " << label << " of " << n;
  }
}

void expect_valid(const Trial& trial, const SmallMesh& mesh) {
  const auto report =
      check_validity(mesh.view(), trial.volume.view(), trial.frame, trial.volume.label_count);
  EXPECT_EQ(report.orientation, 1);
  EXPECT_EQ(report.unused_vertices, 0U);
  for (const audit::Check& c : report.checks) EXPECT_TRUE(c.passed) << c.name << ": " << c.detail;
}

/// Meshes the volume and checks P1 to P3; returns the number of vertices.
std::size_t expect_promises(const Trial& trial, Counter counter) {
  SCOPED_TRACE(trial.text());
  const SmallMesh mesh = small_mesh(run_in_memory(trial));
  expect_same_topology(trial.volume, mesh, counter);
  expect_valid(trial, mesh);
  EXPECT_GE(measure_quality(mesh.view()).radius_ratio_min,
            trial.settings.quality_floor - kRounding);
  return mesh.vertices.size();
}

VolumeKind random_kind(std::mt19937& random) {
  return static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
}

Index3 random_shape(std::mt19937& random, std::uint32_t least, std::uint32_t most) {
  const auto edge = [&] { return std::int64_t{least + below(random, most - least + 1)}; };
  const auto x = edge(), y = edge(), z = edge();
  return {x, y, z};
}

SmallVolume random_small(std::mt19937& random, std::uint32_t least, std::uint32_t most,
                         std::uint32_t labels) {
  const Index3 shape = random_shape(random, least, most);
  const VolumeKind kind = random_kind(random);
  return random_volume_of(random, kind, shape, 1 + below(random, labels));
}

std::int64_t corners(Index3 shape) {
  return (shape + Index3{1, 1, 1}).product();
}

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

TEST(Promise2Validity, OneLabelBecomesFewTetsOfTheExactBox) {
  std::mt19937 random(107);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 12);
    const SmallVolume volume = volume_from(shape, 1, [](auto, auto, auto) { return 0; });
    const std::size_t vertices = expect_promises(random_trial(random, volume), Counter::kAudit);
    EXPECT_GE(vertices, 8U);
  }
}

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

/// Without layers the start mesh may be below the floor; then the run is refused and names the one
/// that it can keep, and keeps it.
TEST(Promise3Quality, FloorThatCannotBeKeptIsRefusedWithTheOneThatCan) {
  std::mt19937 random(112);
  int refused = 0;
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    Trial trial = random_trial(random, random_small(random, 1, 7, 4));
    trial.frame = kThickFrames[below(random, 4)];
    trial.settings.surface = Surface::kVoxel;
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
  EXPECT_GT(refused, 50);
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

}  // namespace
}  // namespace mw::engine
