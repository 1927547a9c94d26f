// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What leaves memory first, and what of the file may be used again when.
#include "engine/store/table/block_table.h"

#include <gtest/gtest.h>

#include "kernels/core/error.h"
#include "tests/engine/store/fake_run.h"
#include "tests/engine/store/volatile_files.h"

namespace mw::engine {
namespace {

using test::fake_layout;
using test::random_block;
using test::VolatileFiles;

class BlockTableTest : public testing::Test {
 protected:
  BlockPin block(std::uint64_t slot) {
    auto out = std::make_shared<EncodedBlock>();
    out->bytes = encode_block(layout_.key(slot), random_block(random_, 30));
    return out;
  }
  [[nodiscard]] std::set<std::uint64_t> cached() const {
    std::set<std::uint64_t> out;
    for (std::uint64_t slot = 0; slot < layout_.slots(); ++slot) {
      if (table_.at(slot).cached != nullptr) out.insert(slot);
    }
    return out;
  }
  [[nodiscard]] std::uint64_t next_use(std::uint64_t slot) const {
    return layout_.next_use(layout_.key(slot), done_);
  }

  std::mt19937 random_{381};
  RunLayout layout_ = fake_layout();
  DoneWindows done_{layout_.windows()};
  VolatileFiles files_;
  SegmentFile disk_{files_.open("blocks")};
  BlockTable table_{layout_, done_, &disk_};
};

TEST_F(BlockTableTest, EvictsWhatIsNeededLast) {
  for (std::uint64_t w = 0; w < layout_.windows(); ++w) {
    if (random_() % 3 == 0) done_.insert(w);
  }
  for (std::uint64_t slot = 0; slot < layout_.slots(); ++slot) {
    if (random_() % 2 == 0) table_.put(slot, block(slot));
  }
  for (std::set<std::uint64_t> before = cached(); !before.empty();) {
    ASSERT_TRUE(table_.evict_one());
    const std::set<std::uint64_t> after = cached();
    ASSERT_EQ(after.size() + 1, before.size());
    std::uint64_t latest_kept = 0, evicted = 0;
    for (std::uint64_t slot : before) {
      std::uint64_t& index = after.contains(slot) ? latest_kept : evicted;
      index = std::max(index, next_use(slot));
    }
    ASSERT_GE(evicted, latest_kept);
    before = after;
  }
  EXPECT_FALSE(table_.evict_one());
}

TEST_F(BlockTableTest, WritesABlockOnce) {
  table_.put(5, block(5));
  const JournalBlock recorded = table_.record(5);
  const std::uint64_t written = table_.bytes_written();
  EXPECT_EQ(written, recorded.extent.size);
  EXPECT_TRUE(table_.evict_one());
  EXPECT_EQ(table_.bytes_written(), written);
  EXPECT_EQ(table_.evicted(), 0U);
}

/// Copy on write: what a record names is kept until the next record is durable.
TEST_F(BlockTableTest, RetiresExtentsThatARecordNames) {
  table_.put(1, block(1));
  table_.put(2, block(2));
  const Extent named = table_.record(1).extent;
  ASSERT_TRUE(table_.evict_one());
  ASSERT_TRUE(table_.evict_one());
  const Extent unnamed = table_.at(2).extent();
  table_.remove(1);
  table_.remove(2);
  EXPECT_TRUE(disk_.take(unnamed)) << "it was free at once";
  EXPECT_FALSE(disk_.take(named));
  EXPECT_EQ(table_.take_retired(), std::vector<Extent>{named});
}

TEST_F(BlockTableTest, RefusesExtentsThatOverlap) {
  table_.put(1, block(1));
  JournalBlock first = table_.record(1);
  table_.remove(1);
  disk_.release(first.extent);
  (void)table_.take_retired();
  table_.restore(first);
  first.slot = 2;
  table_.restore(first);
  EXPECT_THROW(table_.take_extents(), Error);
}

/// A table that asks for room has as many pages as its blocks lie in, whatever came and went.
TEST_F(BlockTableTest, HasThePagesOfItsBlocks) {
  const RunLayout layout = fake_layout({60, 40, 30}, 2);
  const DoneWindows done(layout.windows());
  MemoryBudget budget;
  std::uint64_t page_bytes = 0;
  BlockTable table(layout, done, nullptr, [&](std::uint64_t bytes) {
    page_bytes = bytes;
    return budget.reserve(Purpose::kIndex, bytes);
  });
  constexpr std::uint64_t kPageBlocks = 256;
  ASSERT_GT(layout.slots(), 10 * kPageBlocks);
  const BlockPin any = block(0);
  std::set<std::uint64_t> there;
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    // Few pages at a time, so that some become empty.
    const std::uint64_t page = static_cast<std::uint64_t>(i) / 150 % 10;
    const std::uint64_t slot = page * kPageBlocks + random_() % 3;
    if (there.insert(slot).second) {
      table.put(slot, any);
    } else {
      table.remove(slot);
      there.erase(slot);
    }
    std::set<std::uint64_t> pages;
    for (const std::uint64_t s : there) {
      pages.insert(s / kPageBlocks);
      EXPECT_FALSE(table.at(s).empty());
    }
    EXPECT_TRUE(table.at(slot + 3).empty());
    EXPECT_EQ(budget.used(Purpose::kIndex), pages.size() * page_bytes);
  }
  EXPECT_GE(index_bytes(layout), layout.slots() / kPageBlocks * page_bytes);
  EXPECT_LT(least_index_bytes(layout), index_bytes(layout) / 100);
}

TEST_F(BlockTableTest, StaysAsItIsWithoutRoomForAPage) {
  bool has_room = false;
  MemoryBudget budget;
  BlockTable table(layout_, done_, &disk_, [&](std::uint64_t bytes) {
    if (!has_room) throw Error(ErrorKind::kResource, "no room");
    return budget.reserve(Purpose::kIndex, bytes);
  });
  EXPECT_THROW(table.put(3, block(3)), Error);
  EXPECT_TRUE(table.at(3).empty());
  EXPECT_FALSE(table.evict_one());
  has_room = true;
  table.put(3, block(3));
  EXPECT_FALSE(table.at(3).empty());
}

}  // namespace
}  // namespace mw::engine
