// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks in memory and on disk; eviction by next use (Belady), which follows from the march order.
#include "engine/store/table/block_table.h"

#include <iterator>
#include <utility>

#include "engine/store/codec/byte_codes.h"
#include "engine/store/journal/work_file.h"
#include "io/file/byte_order.h"
#include "kernels/core/assert.h"

namespace mw::engine {

namespace {

std::uint64_t pages_of(const RunLayout& layout, std::uint64_t page_blocks) {
  return (layout.slots() + page_blocks - 1) / page_blocks;
}

}  // namespace

BlockTable::BlockTable(const RunLayout& layout, const DoneWindows& done, SegmentFile* disk,
                       TableRoom room)
    : layout_(layout),
      done_(done),
      disk_(disk),
      room_(std::move(room)),
      pages_(pages_of(layout, kPageBlocks)) {}

const StoredBlock& BlockTable::at(std::uint64_t slot) const {
  static const StoredBlock none;
  const auto& page = pages_[slot / kPageBlocks];
  return page == nullptr ? none : page->blocks[slot % kPageBlocks];
}

StoredBlock& BlockTable::held(std::uint64_t slot) {
  return pages_[slot / kPageBlocks]->blocks[slot % kPageBlocks];
}

StoredBlock& BlockTable::fresh(std::uint64_t slot) {
  auto& page = pages_[slot / kPageBlocks];
  if (page == nullptr) {
    // The room comes first: to make it the table may evict.
    MemoryBudget::Reservation room;
    if (room_) room = room_(sizeof(Page));
    page = std::make_unique<Page>();
    page->room = std::move(room);
  }
  ++page->held;
  return page->blocks[slot % kPageBlocks];
}

void BlockTable::clear(std::uint64_t slot) {
  if (at(slot).empty()) return;
  auto& page = pages_[slot / kPageBlocks];
  page->blocks[slot % kPageBlocks] = {};
  if (--page->held == 0) page.reset();
}

BlockTable::Turn BlockTable::turn(std::uint64_t slot) const {
  return {layout_.next_use(layout_.key(slot), done_), slot};
}

void BlockTable::remove(std::uint64_t slot) {
  const StoredBlock& block = at(slot);
  if (block.cached != nullptr) cached_.erase(turn(slot));
  const bool on_disk = block.size > 0 && !block.kept;
  if (on_disk && block.recorded) retired_.push_back(block.extent());
  if (on_disk && !block.recorded) disk_->release(block.extent());
  clear(slot);
}

void BlockTable::put(std::uint64_t slot, BlockPin pin) {
  MW_ASSERT(at(slot).empty());
  StoredBlock& block = fresh(slot);
  block.sum = sum_of(pin->bytes);
  block.memory_kib = static_cast<std::uint32_t>((pin->memory_bytes + 1023) / 1024);
  block.cached = std::move(pin);
  cached_.insert(turn(slot));
}

void BlockTable::put_kept(std::uint64_t slot, const KeptPlace& place, BlockPin pin) {
  MW_ASSERT(at(slot).empty());
  fresh(slot) = {.cached = std::move(pin),
                 .offset = place.offset,
                 .size = place.size,
                 .sum = place.sum,
                 .memory_kib = place.memory_kib,
                 .kept = true,
                 .part = place.part};
  if (at(slot).cached != nullptr) cached_.insert(turn(slot));
}

void BlockTable::restore(const JournalBlock& from) {
  clear(from.slot);
  fresh(from.slot) = {.cached = nullptr,
                      .offset = from.extent.offset,
                      .size = static_cast<std::uint32_t>(from.extent.size),
                      .sum = from.sum,
                      .memory_kib = static_cast<std::uint32_t>(from.memory_bytes / 1024),
                      .recorded = true};
  forget_parts(layout_.key(from.slot));
}

/// Forgets parts of parts, too: a part that came and went within one group is in no record, and
/// what it was made of is in an earlier one.
void BlockTable::forget_parts(const BlockKey& key) {
  if (key.march == 0) return;
  for (const BlockKey& part : layout_.parts(key)) {
    clear(layout_.slot(part));
    forget_parts(part);
  }
}

void BlockTable::take_extents() {
  for (std::uint64_t slot = 0; slot < layout_.slots(); ++slot) {
    const StoredBlock& block = at(slot);
    if (block.size == 0 || disk_->take(block.extent())) continue;
    throw DamagedWork(name(layout_.key(slot)), "the journal points to where it cannot be");
  }
}

void BlockTable::write(StoredBlock& block) {
  if (block.size > 0) return;
  const Extent extent = disk_->write(block.cached->bytes);
  block.offset = extent.offset;
  block.size = static_cast<std::uint32_t>(extent.size);
  bytes_written_ += extent.size;
}

bool BlockTable::evict_one() {
  if (cached_.empty()) return false;
  const std::uint64_t slot = std::prev(cached_.end())->second;
  if (disk_ == nullptr && !at(slot).kept) return false;
  evict(slot);
  return true;
}

void BlockTable::evict(std::uint64_t slot) {
  StoredBlock& block = held(slot);
  if (block.size == 0) ++evicted_;
  write(block);
  block.cached = nullptr;
  cached_.erase(turn(slot));
}

JournalBlock BlockTable::record(std::uint64_t slot) {
  MW_ASSERT(!at(slot).empty() && !at(slot).kept);
  StoredBlock& block = held(slot);
  write(block);
  block.recorded = true;
  return {slot, block.extent(), block.sum, std::uint64_t{block.memory_kib} * 1024};
}

std::uint64_t index_bytes(const RunLayout& layout) {
  return least_index_bytes(layout) +
         pages_of(layout, BlockTable::kPageBlocks) * sizeof(BlockTable::Page);
}

std::uint64_t least_index_bytes(const RunLayout& layout) {
  return pages_of(layout, BlockTable::kPageBlocks) * sizeof(void*) + layout.windows() / 8;
}

std::uint32_t sum_of(std::span<const std::byte> encoded) {
  return io::load<std::uint32_t>(encoded.data() + kBlockSumAt, io::ByteOrder::kLittle);
}

}  // namespace mw::engine
