// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The labels that windows work from, against the same made directly from the whole volume.
#include "engine/labels/prepared_labels.h"

#include "engine/labels/periodic_labels.h"
#include "io/labels/repeated_volume.h"
#include "kernels/start/carrier_faces.h"
#include "tests/engine/labels/counted_volume.h"
#include "tests/engine/memory_run.h"
#include "tests/kernels/start/cells/large_cells.h"
#include "tests/kernels/start/coarsen/coarse_volume.h"

namespace mw::engine {
namespace {

using namespace mw::test;
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
      EXPECT_EQ(labels.counts().voxels[l], static_cast<std::uint64_t>(std::count(
                                               volume.labels.begin(), volume.labels.end(), l)));
    }
    if (settings.start == StartMesh::kDense) continue;
    expect_levels(labels.levels(), mw::test::level_map(shape), volume.shape);
  }
  EXPECT_GE(changed, 6);
}

/// Around a cell cells of the start mesh are those of the volume that is the cell and its copies.
TEST(PreparedLabels, CellsAroundACellAreThoseOfItsCopies) {
  std::mt19937 random(1072);
  constexpr std::array<Index3, 4> kShapes{{{32, 16, 48}, {16, 16, 16}, {32, 24, 32}, {64, 32, 16}}};
  int allowed = 0;
  for (std::size_t i = 0; i < 16 && !HasFailure(); ++i) {
    const SmallVolume cell = ranked(mw::test::random_volume_of(
        random, mw::test::VolumeKind::kBlobs, kShapes[i % kShapes.size()], 1 + below(random, 3)));
    MeshSettings settings;
    settings.start = i % 2 == 0 ? StartMesh::kCoarse : StartMesh::kOctree;
    settings.periodic = 1 + below(random, 7);
    const Index3 margin = periodic_margin(settings);
    const test::MemoryVolume memory(cell, {});
    const io::PeriodicVolume around(memory, margin);
    const io::LabelTable table = io::collect_labels(around);
    const PreparedLabels labels(io::DenseVolume(around, table), settings);
    SmallVolume whole = cell;
    whole.shape = cell.shape + margin + margin;
    whole.labels = labels.shape({Index3{} - margin, cell.shape + margin}).labels;
    const LevelMap expected = mw::test::level_map(whole);
    const Box3 near = intersection(grown({margin, margin + cell.shape}, LevelMap::kCube),
                                   {{0, 0, 0}, whole.shape});
    for_each_index(near, [&](Index3 v) {
      if (((v.x | v.y | v.z) & 7) != 0) return;
      for (const int level : {3, 4}) {
        ASSERT_EQ(labels.levels().is_allowed(v, level), expected.is_allowed(v, level));
        allowed += expected.is_allowed(v, level) ? 1 : 0;
      }
    });
  }
  EXPECT_GT(allowed, 100);
}

std::int64_t edge_upto(std::mt19937& random, std::int64_t n) {
  return 1 + std::int64_t{below(random, static_cast<std::uint32_t>(n))};
}

/// A box in the volume, now and then an empty one.
Box3 random_part(std::mt19937& random, Index3 shape) {
  if (below(random, 8) == 0) return {};
  const Index3 lo{below(random, static_cast<std::uint32_t>(shape.x)),
                  below(random, static_cast<std::uint32_t>(shape.y)),
                  below(random, static_cast<std::uint32_t>(shape.z))};
  return {lo, lo + Index3{edge_upto(random, shape.x - lo.x), edge_upto(random, shape.y - lo.y),
                          edge_upto(random, shape.z - lo.z)}};
}

MeshSettings settings_of(int i) {
  constexpr std::array<StartMesh, 3> kStarts{StartMesh::kCoarse, StartMesh::kOctree,
                                             StartMesh::kDense};
  MeshSettings settings{.start = kStarts[static_cast<std::size_t>(i) % 3]};
  if (i % 4 == 1) settings.max_distance.reset();
  if (i % 5 == 2) settings.topology = KeptTopology::kInterfaces;
  if (i % 7 == 3) settings.sizes.rules.labels = {{test::raw_label(0), 4.0}};
  return settings;
}

std::int64_t voxels_of(const Box3& bricks, Index3 shape) {
  const Box3 box{{16 * bricks.lo.x, 16 * bricks.lo.y, 16 * bricks.lo.z},
                 {16 * bricks.hi.x, 16 * bricks.hi.y, 16 * bricks.hi.z}};
  return intersection(box, {{0, 0, 0}, shape}).voxels();
}

void expect_same_levels(const LevelMap& share, const LevelMap& whole, const Box3& box) {
  for_each_index(box, [&](Index3 v) {
    for (int level : {3, 4}) {
      ASSERT_EQ(share.is_allowed(v, level), whole.is_allowed(v, level));
    }
  });
}

void expect_same_sizes(const SizeField* share, const SizeField* whole, Index3 shape) {
  ASSERT_EQ(share == nullptr, whole == nullptr);
  if (whole == nullptr) return;
  for_each_index(Index3{shape.x / 8, shape.y / 8, shape.z / 8}, [&](Index3 c) {
    const Point p = lattice_corner({8 * c.x, 8 * c.y, 8 * c.z});
    ASSERT_EQ(share->at(p), whole->at(p));
  });
}

/// Large and odd enough for halos to end inside.
SmallVolume random_long_volume(std::mt19937& random, int i) {
  const auto kind = static_cast<mw::test::VolumeKind>(below(random, audit::test::kVolumeKinds));
  Index3 shape{90 + below(random, 70), 1 + below(random, 40), 1 + below(random, 40)};
  if (i % 3 == 1) std::swap(shape.x, shape.z);
  if (i % 3 == 2) std::swap(shape.x, shape.y);
  SmallVolume volume = mw::test::random_volume_of(random, kind, shape, 1 + below(random, 4));
  // One label in the middle: large cells.
  const Box3 all{{0, 0, 0}, shape}, inner = random_part(random, shape);
  for_each_index(inner, [&](Index3 v) {
    volume.labels[static_cast<std::size_t>(all.offset(v))] = volume.labels[0];
  });
  return ranked(volume);
}

TEST(PreparedLabels, OfAShareTellWhatThoseOfTheWholeTell) {
  std::mt19937 random(1074);
  std::int64_t read = 0, voxels = 0;
  for (int i = 0; i < 120 && !HasFailure(); ++i) {
    const SmallVolume volume = random_long_volume(random, i);
    const MeshSettings settings = settings_of(i);
    const test::MemoryVolume memory(volume, {});
    const test::CountedVolume counted(memory);
    const io::LabelTable table = io::collect_labels(memory);
    const PreparedLabels whole(io::DenseVolume(memory, table), settings);
    const LabelNeed share{random_part(random, volume.shape), random_part(random, volume.shape)};
    const PreparedLabels labels(io::DenseVolume(counted, table), settings, share, 1 + i % 3);
    const Box3 all{{0, 0, 0}, volume.shape};
    SCOPED_TRACE(volume.text() + " share " + std::to_string(i));
    const NeededBricks bricks = bricks_of(share, volume.shape, settings);
    const std::int64_t needed = voxels_of(bricks.original, volume.shape);
    EXPECT_EQ(counted.voxels(), needed);
    read += needed;
    voxels += volume.shape.product();
    if (share.near != Box3{}) {
      EXPECT_EQ(labels.original(share.near).labels, whole.original(share.near).labels);
    }
    EXPECT_EQ(labels.is_coarse(), whole.is_coarse());
    expect_same_sizes(labels.sizes(), whole.sizes(), volume.shape);
    if (share.starts != Box3{}) {
      const Box3 wide = grown(share.starts, kStartHalo);
      EXPECT_EQ(labels.original(wide).labels, whole.original(wide).labels);
      EXPECT_EQ(labels.shape(wide).labels, whole.shape(wide).labels);
      if (settings.start != StartMesh::kDense) {
        expect_same_levels(labels.levels(), whole.levels(),
                           intersection(grown(share.starts, 2), all));
      }
    }
    EXPECT_EQ(counted.voxels(), needed) << "something was read again";
    // Anywhere else, too, where it is read again.
    const Box3 any = grown(random_part(random, volume.shape), 3);
    EXPECT_EQ(labels.original(any).labels, whole.original(any).labels);
  }
  EXPECT_LT(read, voxels * 9 / 10);
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
