// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The first pass by several processes finds what one finds, errors included.
#include <mutex>

#include "engine/labels/label_scan.h"
#include "engine/labels/prepared_labels.h"
#include "engine/run/run.h"
#include "engine/team/team_processes.h"
#include "engine/team/team_run.h"
#include "kernels/core/error.h"
#include "tests/engine/labels/counted_volume.h"
#include "tests/engine/memory_run.h"
#include "tests/engine/team/crowd.h"
#include "tests/expect_error.h"

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
    expect_error(ErrorKind::kUsage, {"ranks 1 and 2 read other labels"},
                 [&] { (void)collect_together(team, volume, 1); });
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

// Several processes know together what one knows, and each reads its part.

TEST(TeamLabels, AreCountedTogetherAsOneCounts) {
  std::mt19937 random(71);
  for (int ranks : {1, 2, 3, 5, 8}) {
    const Index3 shape{20 + below(random, 60), 1 + below(random, 40), 40 + below(random, 90)};
    const auto small =
        audit::test::random_volume_of(random, audit::test::VolumeKind::kSpecks, shape, 5);
    const test::MemoryVolume memory(small, {});
    const io::LabelTable table = io::collect_labels(memory);
    const PreparedLabels whole(io::DenseVolume(memory, table), {.start = StartMesh::kDense});
    std::atomic<std::int64_t> read = 0;
    for_ranks({.ranks = ranks, .seed = 5}, [&](Team& team) {
      const test::CountedVolume counted(memory);
      const LabelCounts counts = count_together(team, io::DenseVolume(counted, table), 2);
      EXPECT_EQ(counts.voxels, whole.counts().voxels);
      EXPECT_TRUE(std::ranges::equal(counts.faces.counts(), whole.counts().faces.counts()));
      read += counted.voxels();
    });
    EXPECT_EQ(read, shape.product());
  }
}

bool is_within(const Box3& part, const Box3& whole) {
  return intersection(part, whole) == part;
}

/// Every window of a rank has its blocks and what is around it in the rank's share.
TEST(TeamLabels, AShareHasAllWindowsOfItsRank) {
  std::mt19937 random(72);
  for (int i = 0; i < 60; ++i) {
    const Index3 shape{8 + below(random, 60), 1 + below(random, 90), 1 + below(random, 120)};
    const Order order = i % 2 == 0 ? Order::kRaster : Order::kColour;
    const RunLayout layout({WindowGrid(shape, 8), WindowGrid(shape, 16)}, order);
    const int ranks = 1 + static_cast<int>(below(random, 9));
    const Partition partition(layout, order, ranks);
    std::vector<LabelNeed> shares;
    for (int rank = 0; rank < ranks; ++rank) {
      shares.push_back(labels_needed(layout, partition, rank, {.window = 8}));
    }
    for (std::uint32_t march = 0; march < 2; ++march) {
      const WindowGrid& grid = layout.grid(march);
      for_each_index(grid.windows(), [&](Index3 w) {
        const auto rank = static_cast<std::size_t>(partition.rank_of({march, w}));
        const LabelNeed& share = shares[rank];
        const Box3 box = grid.window_box(w), all{{0, 0, 0}, shape};
        EXPECT_TRUE(march > 0 || is_within(box, share.starts));
        EXPECT_TRUE(is_within(intersection(grown(box, 6), all), share.near));
      });
    }
  }
}

struct Shares {
  std::int64_t voxels = 0;  ///< that the rank with most has read
  std::uint64_t bytes = 0;  ///< that it has reserved for labels
};

/// A run without work: all voxels have one label.
Shares largest_shares(Index3 shape, int ranks, Order order) {
  const audit::test::SmallVolume small{
      shape, 1, std::vector<Label>(static_cast<std::size_t>(shape.product()), 0)};
  Shares largest;
  std::mutex mutex;
  for_ranks({.ranks = ranks}, [&](Team& team) {
    TeamProcesses processes(team);
    const test::MemoryVolume memory(small, {});
    const io::LabelTable table = io::collect_labels(memory);
    const test::CountedVolume counted(memory);
    test::MemorySink sink;
    const RunReport report =
        mesh_volume(io::DenseVolume(counted, table), {.window = 16, .order = order}, sink,
                    {.processes = &processes});
    const auto bytes = report.peak_bytes_by_purpose[static_cast<std::size_t>(Purpose::kLabels)];
    const std::lock_guard lock(mutex);
    largest.voxels = std::max(largest.voxels, counted.voxels());
    largest.bytes = std::max(largest.bytes, bytes);
  });
  return largest;
}

TEST(TeamLabels, AreReadTheLessTheMoreProcessesThereAre) {
  const Index3 shape{32, 32, 768};
  const Shares one = largest_shares(shape, 1, Order::kColour);
  const Shares four = largest_shares(shape, 4, Order::kColour);
  const Shares eight = largest_shares(shape, 8, Order::kColour);
  EXPECT_EQ(one.voxels, 2 * shape.product());  // counted, then read
  EXPECT_LT(four.voxels, one.voxels / 2);
  EXPECT_LT(eight.voxels, four.voxels * 3 / 4);
  EXPECT_LT(four.bytes, one.bytes);
  // Tiles of rows that are dealt out by turns lie far apart, and all between them is read.
  const Shares raster = largest_shares(shape, 4, Order::kRaster);
  EXPECT_LT(raster.voxels, one.voxels);
}

}  // namespace
}  // namespace mw::engine
