// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tiles cover a volume once, along bricks, and its chunks where they can; labels found by threads.
#include "engine/labels/reading_tiles.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "engine/labels/label_scan.h"
#include "io/labels/brick_volume.h"
#include "io/volume/volume_view.h"
#include "kernels/core/for_each_index.h"
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

/// Says that it has chunks, and counts reads.
class CountedVolume : public io::VolumeView {
 public:
  CountedVolume(const io::LabelVolume& volume, Index3 chunk)
      : VolumeView(volume), info_(volume.info()) {
    info_.chunk = chunk;
  }
  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    voxels_ += box.voxels();
    below().read(box, out);
  }
  [[nodiscard]] std::int64_t voxels() const { return voxels_; }

 private:
  io::VolumeInfo info_;
  mutable std::atomic<std::int64_t> voxels_ = 0;
};

TEST(LabelScan, FindsTheLabelsThatOneThreadFinds) {
  std::mt19937 random(12);
  for (int round = 0; round < 30; ++round) {
    const audit::test::SmallVolume small =
        audit::test::random_volume_of(random, audit::test::VolumeKind::kSpecks, {70, 33, 40},
                                      1 + static_cast<std::uint32_t>(random() % 3000));
    const test::MemoryVolume memory(small, {});
    const CountedVolume volume(memory, {static_cast<std::int64_t>(random() % 40), 20, 17});
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
