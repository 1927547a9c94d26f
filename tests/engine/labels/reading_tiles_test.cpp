// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tiles cover a volume once, along bricks, and its chunks where they can; labels found by threads.
#include "engine/labels/reading_tiles.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/labels/label_scan.h"
#include "io/labels/brick_volume.h"
#include "kernels/core/index.h"
#include "tests/engine/labels/counted_volume.h"
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

constexpr std::int64_t kBrick = io::BrickVolume::kEdge;

TEST(ReadingTiles, CoverTheVolumeOnceAlongBricks) {
  std::mt19937 random(11);
  const auto upto = [&](std::uint32_t n) { return static_cast<std::int64_t>(random() % n); };
  for (int round = 0; round < 300; ++round) {
    io::VolumeInfo info;
    info.shape = {1 + upto(200), 1 + upto(200), 1 + upto(200)};
    if (round % 3 != 0) info.chunk = {1 + upto(300), 1 + upto(300), 1 + upto(300)};
    const ReadingTiles tiles(info);
    std::int64_t covered = 0;
    Index3 next{0, 0, 0};
    for_each_index(tiles.count(), [&](Index3 tile) {
      const Box3 box = tiles.box(tile);
      covered += box.voxels();
      EXPECT_LE(box.voxels(), ReadingTiles::kMaxVoxels);
      EXPECT_TRUE(box.lo.x % kBrick == 0 && box.lo.y % kBrick == 0 && box.lo.z % kBrick == 0);
      EXPECT_TRUE(box.hi.x % kBrick == 0 || box.hi.x == info.shape.x);
      EXPECT_TRUE(box.hi.y % kBrick == 0 || box.hi.y == info.shape.y);
      EXPECT_TRUE(box.hi.z % kBrick == 0 || box.hi.z == info.shape.z);
      EXPECT_GT(box.voxels(), 0);
      if (tile.x == 0) next.x = 0;
      EXPECT_EQ(box.lo.x, next.x);
      next.x = box.hi.x;
    });
    EXPECT_EQ(covered, info.shape.product());
  }
}

TEST(ReadingTiles, AreChunksOfWholeBricks) {
  io::VolumeInfo info;
  info.shape = {300, 200, 100};
  info.chunk = {64, 64, 32};
  EXPECT_EQ(ReadingTiles(info).box({1, 2, 1}), (Box3{{64, 128, 32}, {128, 192, 64}}));
}

/// One after the other, the parts have what the whole has.
TEST(ReadingTiles, ArePartsOfAllThatFollowOneAnother) {
  std::mt19937 random(13);
  for (int round = 0; round < 100; ++round) {
    io::VolumeInfo info;
    const auto edge = [&] { return static_cast<std::int64_t>(1 + random() % 150); };
    info.shape = {edge(), edge(), edge()};
    if (round % 2 == 0) info.chunk = {edge(), edge(), edge()};
    const ReadingTiles tiles(info);
    std::vector<Box3> all, parts;
    for_each_index(tiles.count(), [&](Index3 tile) { all.push_back(tiles.box(tile)); });
    const int count = 1 + static_cast<int>(random() % 9);
    for (int i = 0; i < count; ++i) {
      for (const Box3& box : tiles.boxes({i, count})) parts.push_back(box);
    }
    EXPECT_EQ(parts, all);
  }
}

TEST(ReadingTiles, OverABoxAreThoseThatHaveItsVoxels) {
  std::mt19937 random(14);
  for (int round = 0; round < 100; ++round) {
    io::VolumeInfo info;
    const auto edge = [&] { return static_cast<std::int64_t>(1 + random() % 150); };
    info.shape = {edge(), edge(), edge()};
    info.chunk = {edge(), edge(), edge()};
    const ReadingTiles tiles(info);
    const Index3 lo{edge() % info.shape.x, edge() % info.shape.y, edge() % info.shape.z};
    const Box3 box = intersection({lo, lo + Index3{edge(), edge(), edge()}}, {{}, info.shape});
    const Box3 over = tiles.over(box);
    for_each_index(tiles.count(), [&](Index3 tile) {
      const Box3 both = intersection(tiles.box(tile), box);
      const bool meet = both.lo.x < both.hi.x && both.lo.y < both.hi.y && both.lo.z < both.hi.z;
      EXPECT_EQ(over.contains(tile), meet);
    });
  }
}

TEST(LabelScan, FindsTheLabelsThatOneThreadFinds) {
  std::mt19937 random(12);
  for (int round = 0; round < 30; ++round) {
    const audit::test::SmallVolume small =
        audit::test::random_volume_of(random, audit::test::VolumeKind::kSpecks, {70, 33, 40},
                                      1 + static_cast<std::uint32_t>(random() % 3000));
    const test::MemoryVolume memory(small, {});
    const test::CountedVolume volume(memory, {static_cast<std::int64_t>(random() % 40), 20, 17});
    const io::LabelTable one = io::collect_labels(memory);
    for (const int threads : {1, 2, 5}) {
      const io::LabelTable many = collect_labels(volume, threads);
      ASSERT_EQ(many.size(), one.size());
      for (Label l = 0; l < one.size(); ++l) ASSERT_EQ(many.raw(l), one.raw(l));
    }
    EXPECT_EQ(volume.voxels(), 3 * memory.info().shape.product());
  }
}

}  // namespace
}  // namespace mw::engine
