// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What leaves memory first, and what of the file may be used again when.
#include "engine/store/table/block_table.h"
#include "engine/store/codec/block_codec.h"
#include "engine/store/table/segment_file.h"
#include "kernels/core/error.h"
#include "tests/engine/store/fake_run.h"
#include "tests/engine/store/random_blocks.h"
#include "tests/engine/store/volatile_files.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::engine {
namespace {

using namespace test;
using namespace mw::test;

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

// Extents never share a sector, and what is released comes back whole.

constexpr std::uint64_t kSector = ExtentAllocator::kSectorBytes;
constexpr std::uint64_t kSectors = 256;

/// Does what the allocator does, by a list of sectors.
class Sectors {
 public:
  /// False when one of them is not as it was.
  bool set(const Extent& e, bool taken) {
    if (e.offset % kSector != 0 || e.offset + e.size > kSectors * kSector) return false;
    for (std::uint64_t s = e.offset / kSector; s * kSector < e.offset + e.size; ++s) {
      if (taken_[s] == taken) return false;
      taken_[s] = taken;
    }
    return true;
  }
  [[nodiscard]] std::uint64_t longest_free() const {
    std::uint64_t longest = 0, run = 0;
    for (bool taken : taken_) {
      run = taken ? 0 : run + 1;
      longest = std::max(longest, run);
    }
    return longest * kSector;
  }
  /// The lowest place for that many bytes.
  [[nodiscard]] std::optional<std::uint64_t> first_free(std::uint64_t bytes) const {
    std::uint64_t run = 0;
    for (std::uint64_t s = 0; s < kSectors; ++s) {
      run = taken_[s] ? 0 : run + 1;
      if (run * kSector >= bytes) return (s + 1 - run) * kSector;
    }
    return std::nullopt;
  }

 private:
  std::vector<bool> taken_ = std::vector<bool>(kSectors, false);
};

TEST(ExtentAllocator, AgreesWithAListOfSectors) {
  std::mt19937 random(311);
  for (int trial = 0; trial < 20; ++trial) {
    ExtentAllocator allocator;
    allocator.grow(kSectors * kSector / 2);
    allocator.grow(kSectors * kSector);
    Sectors sectors;
    std::vector<Extent> held;
    for (int i = 0; i < 2000; ++i) {
      if (held.empty() || random() % 2 == 0) {
        const std::uint64_t size = 1 + random() % (12 * kSector);
        const auto extent = allocator.allocate(size);
        ASSERT_EQ(extent.has_value(), size <= sectors.longest_free());
        if (!extent) continue;
        ASSERT_EQ(extent->size, size);
        ASSERT_TRUE(sectors.set(*extent, true));
        held.push_back(*extent);
      } else {
        std::swap(held[random() % held.size()], held.back());
        allocator.release(held.back());
        ASSERT_TRUE(sectors.set(held.back(), false));
        held.pop_back();
      }
    }
    for (const Extent& e : held) allocator.release(e);
    EXPECT_EQ(allocator.free_bytes(), kSectors * kSector);
    EXPECT_TRUE(allocator.allocate(kSectors * kSector));
  }
}

TEST(ExtentAllocator, TakesTheLowestPlaceBeforeAnEnd) {
  std::mt19937 random(313);
  std::size_t found = 0, refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    ExtentAllocator allocator;
    allocator.grow(kSectors * kSector);
    Sectors sectors;
    for (int i = 0; i < 120; ++i) {
      const Extent taken{random() % kSectors * kSector, kSector};
      EXPECT_EQ(allocator.take(taken), sectors.set(taken, true));
    }
    const std::uint64_t size = 1 + random() % (8 * kSector);
    const std::uint64_t end = random() % kSectors * kSector;
    const auto first = sectors.first_free(size);
    const bool fits = first && *first + size <= end;
    const auto extent = allocator.allocate_before(end, size);
    ASSERT_EQ(extent.has_value(), fits);
    (fits ? found : refused) += 1;
    EXPECT_EQ(extent.value_or(Extent{}), fits ? (Extent{*first, size}) : Extent{});
  }
  EXPECT_GT(found, 50U);
  EXPECT_GT(refused, 30U);
}

TEST(ExtentAllocator, EndsWithTheLastExtentWhenTrimmed) {
  std::mt19937 random(312);
  for (int trial = 0; trial < 200; ++trial) {
    ExtentAllocator allocator;
    allocator.grow(kSectors * kSector);
    std::vector<Extent> held;
    while (const auto extent = allocator.allocate(1 + random() % (40 * kSector))) {
      held.push_back(*extent);
    }
    std::shuffle(held.begin(), held.end(), random);
    const std::size_t left = random() % held.size();
    while (held.size() > left) {
      allocator.release(held.back());
      held.pop_back();
    }
    std::uint64_t end = 0;
    for (const Extent& e : held) {
      end = std::max(end, (e.offset + e.size + kSector - 1) / kSector * kSector);
    }
    allocator.trim();
    EXPECT_EQ(allocator.end(), end);
    allocator.grow(kSectors * kSector);
    for (const Extent& e : held) allocator.release(e);
    EXPECT_EQ(allocator.free_bytes(), kSectors * kSector);
  }
}

TEST(ExtentAllocator, TakesGivenExtentsOnce) {
  ExtentAllocator allocator;
  allocator.grow(16 * kSector);
  EXPECT_TRUE(allocator.take({4 * kSector, 3 * kSector - 5}));
  EXPECT_FALSE(allocator.take({6 * kSector, kSector}));
  EXPECT_FALSE(allocator.take({3 * kSector, 2 * kSector}));
  EXPECT_FALSE(allocator.take({15 * kSector, 2 * kSector}));
  EXPECT_FALSE(allocator.take({99 * kSector, 1}));
  EXPECT_TRUE(allocator.take({7 * kSector, kSector}));
  EXPECT_EQ(allocator.free_bytes(), 12 * kSector);
}

// Blocks come back from bytes bit by bit, and damaged bytes are refused.

constexpr BlockKey kKey{1, {3, 4, 5}};

/// What the bytes decode to; nothing when they are refused, which must name block and reason.
std::optional<BlockMesh> decode_or_refuse(const std::vector<std::byte>& bytes) {
  try {
    return decode_block(kKey, bytes);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(e.what()).find("block (3, 4, 5) of march 2: corrupt: "),
              std::string::npos)
        << e.what();
    return std::nullopt;
  }
}

std::vector<BlockMesh> start_blocks(std::mt19937& random) {
  std::vector<BlockMesh> out;
  for (int i = 0; i < 6; ++i) {
    const auto volume = random_volume_of(random, static_cast<VolumeKind>(i), {8, 8, 8}, 4);
    out.push_back(mw::test::dense_block(volume, {{0, 0, 0}, {4, 8, 8}},
                                        {.with_samples = i % 2 == 0, .weights = {}}));
  }
  return out;
}

TEST(BlockCodec, GivesBackEveryBit) {
  std::mt19937 random(301);
  std::vector<BlockMesh> blocks = start_blocks(random);
  blocks.push_back({});
  for (std::size_t size = 4; size < 200; ++size) blocks.push_back(random_block(random, size));
  for (const BlockMesh& block : blocks) {
    const std::vector<std::byte> bytes = encode_block(kKey, block);
    const BlockMesh back = decode_block(kKey, bytes);
    ASSERT_TRUE(same_bits(block, back));
    ASSERT_EQ(encode_block(kKey, back), bytes);
  }
}

TEST(BlockCodec, IsCompact) {
  std::mt19937 random(302);
  for (const BlockMesh& block : start_blocks(random)) {
    EXPECT_LT(4 * encode_block(kKey, block).size(), memory_bytes(block));
  }
}

TEST(BlockCodec, RefusesTheBytesOfAnotherBlock) {
  std::mt19937 random(303);
  const BlockMesh block = random_block(random, 50);
  for (const BlockKey& other : {BlockKey{0, {3, 4, 5}}, BlockKey{1, {3, 5, 4}}}) {
    EXPECT_FALSE(decode_or_refuse(encode_block(other, block)));
  }
}

TEST(BlockCodec, RefusesEveryTruncation) {
  std::mt19937 random(304);
  const std::vector<std::byte> bytes = encode_block(kKey, random_block(random, 40));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_or_refuse({bytes.begin(), bytes.begin() + static_cast<long>(size)}));
  }
  std::vector<std::byte> longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_or_refuse(longer));
}

TEST(BlockCodec, RefusesEveryChangedByte) {
  std::mt19937 random(305);
  std::vector<std::byte> bytes = encode_block(kKey, random_block(random, 40));
  for (std::byte& byte : bytes) {
    const std::byte kept = byte;
    byte ^= static_cast<std::byte>(1 + random() % 255);
    EXPECT_FALSE(decode_or_refuse(bytes));
    byte = kept;
  }
}

/// With the checksum made right, damage is either refused or another canonical mesh, which has an
/// encoding of its own; it never crashes (run it under sanitizers) and never asks for much memory.
TEST(BlockCodec, SurvivesDamageUnderAGoodChecksum) {
  std::mt19937 random(306);
  int refused = 0, accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::byte> bytes = encode_block(kKey, random_block(random, 12));
    for (std::size_t k = 1 + random() % 3; k > 0; --k) {
      const std::size_t at = 16 + random() % (bytes.size() - 16);
      if (random() % 4 != 0) {
        bytes[at] = static_cast<std::byte>(random());
      } else {
        bytes.erase(bytes.begin() + static_cast<long>(at), bytes.end());
        bytes.resize(17 + random() % 300, static_cast<std::byte>(random()));
      }
    }
    repair_head(bytes);
    const std::optional<BlockMesh> mesh = decode_or_refuse(bytes);
    ++(mesh ? accepted : refused);
    if (!mesh) continue;
    ASSERT_TRUE(same_bits(decode_block(kKey, encode_block(kKey, *mesh)), *mesh));
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace mw::engine
