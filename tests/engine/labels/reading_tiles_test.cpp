// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tiles cover a volume once, along bricks, and its chunks where they can; labels found by threads;
// one thread has several reads of a volume far away under way, and gets the same labels.
#include "engine/labels/reading_tiles.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>

#include "engine/labels/label_counts.h"
#include "engine/labels/label_regions.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/prepared_labels.h"
#include "io/labels/prepared_input.h"
#include "kernels/core/index.h"
#include "tests/engine/labels/counted_volume.h"
#include "tests/engine/memory_run.h"
#include "tests/io/labels/memory_volume.h"

namespace mw::engine {
namespace {

using audit::test::below;

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

// Contacts of labels against a plain loop over the array.

TEST(LabelContacts, AreThoseOfAPlainLoop) {
  std::mt19937 random(3);
  for (std::int64_t seed = 0; seed < 12; ++seed) {
    // The last one has several tiles along y and z.
    test::SmallVolume small{seed == 11 ? Index3{700, 30, 40} : Index3{7 + seed % 3, 5, 1 + seed}};
    small.labels.resize(static_cast<std::size_t>(small.shape.product()));
    for (Label& label : small.labels) label = static_cast<Label>(random() % 5);
    const test::MemoryVolume volume(small, {});
    const Box3 all{{0, 0, 0}, small.shape};
    std::map<std::pair<RawLabel, RawLabel>, std::array<std::uint64_t, 3>> expected;
    const std::array<Index3, 3> steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const auto at = [&](Index3 v) {
      return test::raw_label(small.labels[static_cast<std::size_t>(all.offset(v))]);
    };
    for_each_index(small.shape, [&](Index3 v) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!all.contains(v + steps[k])) continue;
        const std::pair<RawLabel, RawLabel> pair = std::minmax({at(v), at(v + steps[k])});
        if (pair.first != pair.second) ++expected[pair][k];
      }
    });
    auto next = expected.begin();
    for (const LabelContact& contact : label_contacts(volume, seed % 2 == 0 ? 1 : 4)) {
      ASSERT_NE(next, expected.end());
      EXPECT_EQ(std::pair(contact.first, contact.second), next->first);
      EXPECT_EQ(contact.faces, next->second);
      ++next;
    }
    EXPECT_EQ(next, expected.end());
  }
}

// What parts count adds up to what the whole counts.

audit::test::SmallVolume random_of_many_tiles(std::mt19937& random, std::uint32_t kind) {
  const Index3 shape{1 + below(random, 80), 1 + below(random, 60), 1 + below(random, 90)};
  return audit::test::random_volume_of(
      random, static_cast<audit::test::VolumeKind>(kind % audit::test::kVolumeKinds), shape,
      1 + below(random, 5));
}

TEST(LabelCounts, OfPartsAddUpToThoseOfTheWhole) {
  std::mt19937 random(61);
  for (std::uint32_t i = 0; i < 40; ++i) {
    const auto small = random_of_many_tiles(random, i);
    const test::MemoryVolume memory(small, {});
    const io::LabelTable table = io::collect_labels(memory);
    const io::DenseVolume volume(memory, table);
    const PreparedLabels whole(volume, {.start = StartMesh::kDense});
    const int parts = 1 + static_cast<int>(below(random, 6));
    LabelCounts sum(small.shape, table.size());
    for (int part = 0; part < parts; ++part) {
      const LabelCounts more = counts_of_part(volume, 1 + part % 3, {part, parts});
      sum.faces.add(0, more.faces.counts());
      for (std::size_t l = 0; l < table.size(); ++l) sum.voxels[l] += more.voxels[l];
    }
    EXPECT_EQ(sum.voxels, whole.counts().voxels);
    EXPECT_TRUE(std::ranges::equal(sum.faces.counts(), whole.counts().faces.counts()));
  }
}

/// Labels may be stored in chunks of any size.  What is counted decides on the mesh.
TEST(LabelCounts, DoNotDependOnHowTheVolumeIsStored) {
  std::mt19937 random(62);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const auto small = random_of_many_tiles(random, i);
    const test::MemoryVolume memory(small, {});
    const io::LabelTable table = io::collect_labels(memory);
    const LabelCounts plain = counts_of_part(io::DenseVolume(memory, table), 1, {});
    const Index3 chunk{1 + below(random, 100), 1 + below(random, 100), 1 + below(random, 100)};
    const test::CountedVolume stored(memory, chunk);
    const LabelCounts chunked = counts_of_part(io::DenseVolume(stored, table), 1, {});
    EXPECT_EQ(chunked.voxels, plain.voxels);
    EXPECT_TRUE(std::ranges::equal(chunked.faces.counts(), plain.faces.counts()));
  }
}

constexpr std::uint64_t kBudget = std::uint64_t{256} << 20U;

/// Each read waits until two are under way, as long as it is to be met.
class MeetingVolume : public io::VolumeView {
 public:
  using VolumeView::VolumeView;

  void read(const Box3& box, std::span<RawLabel> out) const override {
    {
      std::unique_lock lock(mutex_);
      ++reads_;
      changed_.notify_all();
      const auto is_met = [this] { return !is_to_meet_ || reads_ > 1; };
      if (!changed_.wait_for(lock, std::chrono::seconds(20), is_met)) {
        throw std::runtime_error("alone");
      }
    }
    below().read(box, out);
  }
  void meet(bool is_to_meet) {
    is_to_meet_ = is_to_meet;
    reads_ = 0;
  }
  [[nodiscard]] int reads() const { return reads_; }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable int reads_ = 0;
  bool is_to_meet_ = true;
};

io::MemoryVolume far_volume(io::VoxelType type = io::VoxelType::kU64) {
  constexpr Index3 kShape{40, 33, 20};
  std::vector<RawLabel> labels(static_cast<std::size_t>(kShape.product()));
  std::iota(labels.begin(), labels.end(), RawLabel{1});
  io::MemoryVolume out(kShape, type, std::move(labels));
  out.info().is_far = true;
  out.info().chunk = {16, 16, 16};
  return out;
}

std::vector<RawLabel> read_all(const io::LabelVolume& volume, const Box3& box) {
  std::vector<RawLabel> out(static_cast<std::size_t>(box.voxels()));
  volume.read(box, out);
  return out;
}

TEST(SharedReads, SeveralThreadsReadALargeBox) {
  const io::MemoryVolume labels = far_volume();
  const MeetingVolume volume(labels);
  const SharedReads shared(volume, kBudget);
  const Box3 box{{3, 5, 7}, {38, 33, 9}};
  EXPECT_EQ(read_all(shared, box), read_all(labels, box));
  EXPECT_EQ(volume.reads(), 3 * 3);
}

TEST(SharedReads, AThreadReadsAloneAfterTheEnd) {
  const io::MemoryVolume labels = far_volume();
  MeetingVolume volume(labels);
  volume.meet(false);
  SharedReads shared(volume, kBudget);
  shared.end();
  const Box3 box{{0, 0, 0}, labels.info().shape};
  EXPECT_EQ(read_all(shared, box), labels.labels());
  EXPECT_EQ(volume.reads(), 1);
}

/// What is near, what may be no label, and what a little budget has no room for.
TEST(SharedReads, OtherVolumesAreReadAsTheyAre) {
  io::MemoryVolume near = far_volume();
  near.info().is_far = false;
  for (const io::MemoryVolume& labels : {near, far_volume(io::VoxelType::kF32), far_volume()}) {
    MeetingVolume volume(labels);
    volume.meet(false);
    const bool is_budget_little = labels.info().is_far && !is_float(labels.info().type);
    const SharedReads shared(volume, is_budget_little ? 1 << 20 : kBudget);
    (void)read_all(shared, {{0, 0, 0}, labels.info().shape});
    EXPECT_EQ(volume.reads(), 1);
  }
}

TEST(SharedReads, SpecksAndWeldsAreLookedForByThem) {
  const io::MemoryVolume labels = far_volume();
  MeetingVolume volume(labels);
  const SharedReads shared(volume, kBudget);
  for (const io::InputSteps& steps :
       {io::InputSteps{.merge = {}, .specks = io::SpeckRule{1}, .weld = {}},
        io::InputSteps{.merge = {}, .specks = {}, .weld = {1}}}) {
    volume.meet(true);
    EXPECT_NO_THROW(io::PreparedInput(shared, steps));
    EXPECT_GT(volume.reads(), 1);
  }
}

}  // namespace
}  // namespace mw::engine
