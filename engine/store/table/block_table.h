// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where each block of a run is (in memory, on disk, or both), and which one leaves memory next.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <set>
#include <utility>

#include "engine/store/block_keeper.h"
#include "engine/store/journal/journal.h"
#include "engine/store/memory_budget.h"
#include "engine/store/run_layout.h"
#include "engine/store/table/segment_file.h"

namespace mw::engine {

/// A block as bytes in memory.  Each owner of a shared pointer to it pins it; its part of the
/// budget is given back with the last pin.
struct EncodedBlock {
  std::vector<std::byte> bytes;
  std::uint64_t memory_bytes = 0;  ///< the size of the decoded block
  MemoryBudget::Reservation room;
};
using BlockPin = std::shared_ptr<const EncodedBlock>;

/// A version of a block, in memory (cached), on disk, or both.
struct StoredBlock {
  BlockPin cached;
  std::uint64_t offset = 0;
  std::uint32_t size = 0;  ///< bytes on disk; 0 if it is not there
  std::uint32_t sum = 0;
  std::uint32_t memory_kib = 0;
  bool recorded = false;  ///< a record of the journal, written or being written, points to it
  bool kept = false;      ///< offset, size, sum and part are those of a KeptPlace
  std::uint8_t part = 0;

  [[nodiscard]] Extent extent() const { return {offset, size}; }
  /// REQUIRES: kept.
  [[nodiscard]] KeptPlace place() const { return {offset, size, sum, memory_kib, part}; }
  [[nodiscard]] bool empty() const { return cached == nullptr && size == 0 && !kept; }
};

/// Reserves memory for a table, and may evict blocks from that table to get it.
using TableRoom = std::function<MemoryBudget::Reservation(std::uint64_t bytes)>;

/// The blocks of a run by slot, in pages that are there as long as one of their blocks is: a
/// process that has a part of a run's blocks has that part of the table.  It copies on write: an
/// extent that a record points to is used again only when a later record is durable, see
/// take_retired().  Thread safety: none; but pins, and extents of blocks that nobody replaces, may
/// be read at any time.
class BlockTable {
 public:
  /// Without a disk only blocks that are kept can be evicted.  room is asked for each page; if it
  /// is null, there is room for all of them.  The references outlive it.
  BlockTable(const RunLayout& layout, const DoneWindows& done, SegmentFile* disk,
             TableRoom room = {});

  [[nodiscard]] const StoredBlock& at(std::uint64_t slot) const;

  /// Forgets the block, if there is one.
  void remove(std::uint64_t slot);
  /// REQUIRES: no block there.  ERRORS: those of the room; then nothing has changed.
  void put(std::uint64_t slot, BlockPin block);
  /// Puts a block there that is kept; it is in memory, too, unless the pin is null.  A version
  /// that KeptPlace says is not kept (size 0) cannot be read, only be replaced.
  void put_kept(std::uint64_t slot, const KeptPlace& place, BlockPin block = nullptr);
  /// Replaces the block that is there by one that the journal names; does not yet take its extent.
  /// ERRORS: those of the room.
  void restore(const JournalBlock& block);
  /// Takes the extents of all restored blocks.
  /// ERRORS: mw::Error(kInput) when they overlap or lie outside the file.
  void take_extents();

  /// Drops from memory the block that is needed last, writing it first if it is not on disk.
  /// Returns false when there is none, or no place for it.
  bool evict_one();
  /// Drops a block from memory, writing it first if it is not on disk.  REQUIRES: it is in memory,
  /// and kept or there is a disk.
  void evict(std::uint64_t slot);
  /// Writes the block if it is not on disk, and returns what a record says of it.  REQUIRES: a
  /// disk; the block is there and not kept.
  [[nodiscard]] JournalBlock record(std::uint64_t slot);
  /// Returns the extents that no block has any more but some record points to.  They may be
  /// released when the next record is durable.
  [[nodiscard]] std::vector<Extent> take_retired() { return std::exchange(retired_, {}); }

  [[nodiscard]] std::uint64_t evicted() const { return evicted_; }
  [[nodiscard]] std::uint64_t bytes_written() const { return bytes_written_; }

 private:
  using Turn = std::pair<std::uint64_t, std::uint64_t>;  ///< next use, slot
  static constexpr std::uint64_t kPageBlocks = 256;
  struct Page {
    MemoryBudget::Reservation room;
    std::uint64_t held = 0;  ///< blocks that are not empty
    std::array<StoredBlock, kPageBlocks> blocks;
  };
  friend std::uint64_t index_bytes(const RunLayout& layout);
  friend std::uint64_t least_index_bytes(const RunLayout& layout);

  /// REQUIRES: there is one.
  [[nodiscard]] StoredBlock& held(std::uint64_t slot);
  /// Returns an empty block of that slot, which must be filled next.
  [[nodiscard]] StoredBlock& fresh(std::uint64_t slot);
  void clear(std::uint64_t slot);
  [[nodiscard]] Turn turn(std::uint64_t slot) const;
  void forget_parts(const BlockKey& key);
  void write(StoredBlock& block);

  const RunLayout& layout_;
  const DoneWindows& done_;
  SegmentFile* disk_;
  TableRoom room_;
  std::vector<std::unique_ptr<Page>> pages_;
  std::set<Turn> cached_;  ///< a block's turn changes only when a window over it is done
  std::vector<Extent> retired_;
  std::uint64_t evicted_ = 0;
  std::uint64_t bytes_written_ = 0;
};

/// Returns the bytes that the tables of a run take with all their pages, without the blocks.
[[nodiscard]] std::uint64_t index_bytes(const RunLayout& layout);
/// Returns what these tables take without any page, for a table that asks for room.
[[nodiscard]] std::uint64_t least_index_bytes(const RunLayout& layout);

/// Returns what identifies the bytes of a version: the checksum that its encoding holds.
[[nodiscard]] std::uint32_t sum_of(std::span<const std::byte> encoded);

}  // namespace mw::engine
