// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The labels that windows work from, against the same made directly from the whole volume.
#include "engine/labels/prepared_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "kernels/start/carrier_faces.h"
#include "tests/engine/memory_run.h"
#include "tests/kernels/start/coarse_volume.h"
#include "tests/kernels/start/large_cells.h"

namespace mw::engine {
namespace {

using mw::test::below;
using mw::test::labels_in;
using test::SmallVolume;

/// Labels by rank, so that they are the dense ones.
SmallVolume ranked(SmallVolume volume) {
  const std::set<Label> labels(volume.labels.begin(), volume.labels.end());
  for (Label& l : volume.labels) {
    l = static_cast<Label>(std::distance(labels.begin(), labels.find(l)));
  }
  volume.label_count = labels.size();
  return volume;
}

SmallVolume random_of_many_bricks(std::mt19937& random, int i) {
  if (i % 2 == 0) return ranked(mw::test::random_with_large_cells(random));
  const auto any = static_cast<mw::test::VolumeKind>(below(random, audit::test::kVolumeKinds));
  const auto kind = below(random, 2) == 0 ? any : mw::test::VolumeKind::kBlobs;
  const Index3 shape{40 + below(random, 60), 1 + below(random, 50), 1 + below(random, 50)};
  return ranked(mw::test::random_volume_of(random, kind, shape, 1 + below(random, 6)));
}

PreparedLabels prepared(const SmallVolume& volume, const MeshSettings& settings, int threads = 1) {
  const test::MemoryVolume memory(volume, {});
  const io::LabelTable table = io::collect_labels(memory);
  return {io::DenseVolume(memory, table), settings, threads};
}

void expect_levels(const LevelMap& actual, const LevelMap& expected, Index3 shape) {
  for_each_index(shape, [&](Index3 v) {
    if (((v.x | v.y | v.z) & 7) != 0) return;
    for (int level : {3, 4}) {
      ASSERT_EQ(actual.is_allowed(v, level), expected.is_allowed(v, level));
    }
  });
}

TEST(PreparedLabels, AreWhatTheWholeVolumeGivesDirectly) {
  std::mt19937 random(1071);
  constexpr std::array<StartMesh, 3> kStarts{StartMesh::kCoarse, StartMesh::kOctree,
                                             StartMesh::kDense};
  int changed = 0;
  for (int i = 0; i < 48 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of_many_bricks(random, i);
    const MeshSettings settings{.start = kStarts[static_cast<std::size_t>(i) % 3],
                                .max_distance = i % 4 == 0 ? 1.0 : 1.5};
    const PreparedLabels labels = prepared(volume, settings, 1 + i % 4);
    const bool coarse = settings.start == StartMesh::kCoarse;
    const SmallVolume shape = coarse ? mw::test::coarsened(volume, *settings.max_distance) : volume;
    changed += shape.labels != volume.labels ? 1 : 0;
    const Box3 box{{-5, -6, -7}, volume.shape + Index3{4, 3, 20}};
    EXPECT_EQ(labels.is_coarse(), coarse);
    EXPECT_EQ(labels.original(box).labels, labels_in(volume, box).labels);
    EXPECT_EQ(labels.shape(box).labels, labels_in(shape, box).labels);
    for (Label l = 0; l < volume.label_count; ++l) {
      EXPECT_EQ(labels.label_voxels()[l], static_cast<std::uint64_t>(std::count(
                                              volume.labels.begin(), volume.labels.end(), l)));
    }
    if (settings.start == StartMesh::kDense) continue;
    expect_levels(labels.levels(), mw::test::level_map(shape), volume.shape);
  }
  EXPECT_GE(changed, 6);
}

/// Flips of voxels keep labels, not their meetings.
TEST(PreparedLabels, AreNotCoarsenedWhereInterfacesAreKept) {
  std::mt19937 random(1073);
  const SmallVolume volume =
      ranked(mw::test::random_volume_of(random, mw::test::VolumeKind::kBlobs, {20, 20, 20}, 3));
  const PreparedLabels labels =
      prepared(volume, {.start = StartMesh::kCoarse, .topology = KeptTopology::kInterfaces});
  EXPECT_FALSE(labels.is_coarse());
  EXPECT_EQ(labels.shape({{0, 0, 0}, volume.shape}).labels, volume.labels);
}

/// Coarsening without a bound keeps the widest that it makes use of.
TEST(PreparedLabels, CoarsenAlsoWithoutABound) {
  std::mt19937 random(1072);
  const SmallVolume volume =
      ranked(mw::test::random_volume_of(random, mw::test::VolumeKind::kBlobs, {40, 20, 20}, 3));
  const PreparedLabels labels =
      prepared(volume, {.start = StartMesh::kCoarse, .max_distance = std::nullopt});
  const Box3 all{{0, 0, 0}, volume.shape};
  EXPECT_EQ(labels.shape(all).labels, mw::test::coarsened(volume, kMaxCoarseDistance).labels);
  EXPECT_NE(labels.shape(all).labels, volume.labels);
}

}  // namespace
}  // namespace mw::engine
