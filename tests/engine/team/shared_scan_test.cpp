// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The first pass by several processes finds what one finds, errors included.
#include "engine/team/team_labels.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/labels/label_scan.h"
#include "kernels/core/error.h"
#include "tests/engine/labels/counted_volume.h"
#include "tests/engine/memory_run.h"
#include "tests/engine/team/crowd.h"

namespace mw::engine {
namespace {

using audit::test::below;
using test::for_ranks;

audit::test::SmallVolume random_volume(std::mt19937& random) {
  const Index3 shape{1 + below(random, 60), 1 + below(random, 40), 1 + below(random, 90)};
  return audit::test::random_volume_of(random, audit::test::VolumeKind::kSpecks, shape,
                                       1 + below(random, 2000));
}

TEST(SharedScan, FindsTheLabelsAndTheFingerprintOfOneProcess) {
  std::mt19937 random(81);
  for (int ranks : {1, 2, 3, 4, 8}) {
    const auto small = random_volume(random);
    const test::MemoryVolume memory(small, {});
    const FingerprintVolume alone(memory);
    const io::LabelTable table = collect_labels(alone, 1);
    std::atomic<std::int64_t> read = 0;
    for_ranks({.ranks = ranks, .max_delay = std::chrono::microseconds(200)}, [&](Team& team) {
      const test::CountedVolume counted(memory);
      FingerprintVolume volume(counted);
      const io::LabelTable shared = collect_together(team, volume, 2);
      EXPECT_EQ(volume.text(), alone.text());
      ASSERT_EQ(shared.size(), table.size());
      for (Label l = 0; l < table.size(); ++l) EXPECT_EQ(shared.raw(l), table.raw(l));
      read += counted.voxels();
    });
    std::int64_t tile = 0;
    const ReadingTiles tiles(memory.info());
    for_each_index(tiles.count(), [&](Index3 t) { tile = std::max(tile, tiles.box(t).voxels()); });
    EXPECT_GE(read, small.shape.product());
    EXPECT_LE(read, small.shape.product() + (ranks > 1 ? 2 * ranks * tile : 0));
  }
}

/// Together they would see labels that none of them has all of.
TEST(SharedScan, RefusesVolumesThatDiffer) {
  std::mt19937 random(83);
  const auto small =
      audit::test::random_volume_of(random, audit::test::VolumeKind::kSpecks, {20, 33, 70}, 9);
  auto other = small;
  for (Label& l : other.labels) l += 1;
  for_ranks({.ranks = 4}, [&](Team& team) {
    const test::MemoryVolume memory(team.rank() == 2 ? other : small, {});
    FingerprintVolume volume(memory);
    try {
      (void)collect_together(team, volume, 1);
      ADD_FAILURE() << "the volumes differ";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      EXPECT_NE(std::string(error.what()).find("ranks 1 and 2 read other labels"),
                std::string::npos)
          << error.what();
    }
  });
}

/// A volume of floats with voxels that are no labels.
class BadVolume : public io::VolumeView {
 public:
  BadVolume(const io::LabelVolume& volume, bool z_fastest, std::vector<Index3> bad)
      : VolumeView(volume), info_(volume.info()), bad_(std::move(bad)) {
    info_.type = io::VoxelType::kF32;
    info_.z_fastest = z_fastest;
  }
  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    below().read(box, out);
    std::optional<Index3> first;
    for (const Index3 v : bad_) {
      if (box.contains(v) && (!first || place(v) < place(*first))) first = v;
    }
    if (first) throw Error(ErrorKind::kInput, "bad voxel " + std::to_string(place(*first)));
  }

 private:
  /// In the file.
  [[nodiscard]] std::int64_t place(Index3 v) const {
    const Index3 s = info_.shape;
    return info_.z_fastest ? (v.x * s.y + v.y) * s.z + v.z : (v.z * s.y + v.y) * s.x + v.x;
  }

  io::VolumeInfo info_;
  std::vector<Index3> bad_;
};

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    return error.what();
  }
  return "none";
}

TEST(SharedScan, TellsOfTheFirstVoxelInTheFileThatIsNoLabel) {
  std::mt19937 random(82);
  for (int i = 0; i < 40; ++i) {
    const auto small = random_volume(random);
    const test::MemoryVolume memory(small, {});
    std::vector<Index3> bad;
    for (std::uint32_t n = below(random, 4); n > 0; --n) {
      bad.push_back({below(random, static_cast<std::uint32_t>(small.shape.x)),
                     below(random, static_cast<std::uint32_t>(small.shape.y)),
                     below(random, static_cast<std::uint32_t>(small.shape.z))});
    }
    const BadVolume volume(memory, i % 2 == 0, bad);
    const std::string expected = error_of([&] { (void)collect_labels(volume, 1); });
    for_ranks({.ranks = 1 + i % 5}, [&](Team& team) {
      FingerprintVolume own(volume);
      EXPECT_EQ(error_of([&] { (void)collect_together(team, own, 1); }), expected);
    });
  }
}

}  // namespace
}  // namespace mw::engine
