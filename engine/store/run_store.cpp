// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Windows take and commit blocks, and blocks leave memory to make room.
#include "engine/store/run_store.h"

#include <algorithm>
#include <utility>

#include "engine/store/journal/run_folder.h"
#include "engine/store/journal/work_file.h"
#include "io/file/errors.h"
#include "kernels/core/assert.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {
namespace {

/// What a block takes beside its bytes: EncodedBlock, its place in the table, allocator's overhead.
constexpr std::uint64_t kBytesPerBlock = sizeof(EncodedBlock) + 144;

/// Returns the box of the voxels that a block's vertices touch.
Box3 voxels_of(const BlockMesh& mesh) {
  Box3 out;
  for (const BlockVertex& v : mesh.vertices) {
    const auto floor_voxel = [](std::int32_t u) { return std::int64_t{u} / kUnitsPerVoxel; };
    const Index3 at{floor_voxel(v.position.x), floor_voxel(v.position.y),
                    floor_voxel(v.position.z)};
    if (&v == mesh.vertices.data()) out = {at, at};
    out = {{std::min(out.lo.x, at.x), std::min(out.lo.y, at.y), std::min(out.lo.z, at.z)},
           {std::max(out.hi.x, at.x), std::max(out.hi.y, at.y), std::max(out.hi.z, at.z)}};
  }
  if (!mesh.vertices.empty()) out.hi = out.hi + Index3{1, 1, 1};
  return out;
}

BlockPin pin_of(std::vector<std::byte> encoded, std::uint64_t memory_bytes,
                MemoryBudget::Reservation room) {
  auto block = std::make_shared<EncodedBlock>();
  block->bytes = std::move(encoded);
  block->memory_bytes = memory_bytes;
  block->room = std::move(room);
  return block;
}

std::unique_ptr<SegmentFile> open_disk(WorkFiles* files, BlockKeeper* keeper) {
  if (files != nullptr) return std::make_unique<SegmentFile>(files->open(kBlocksFile));
  if (keeper != nullptr) return std::make_unique<SegmentFile>(keeper->open_spill());
  return nullptr;
}

}  // namespace

/// Where a block, or one of its parts, is; `cached` is a pin.
struct RunStore::Source {
  BlockKey key;
  BlockPin cached;
  Extent extent;
  std::uint32_t sum = 0;
  std::optional<KeptPlace> kept = std::nullopt;  ///< used instead of the extent where it is there
};

/// The store as the windows of one march see it.
class RunStore::March : public BlockStore {
 public:
  March(RunStore& run, std::uint32_t march) : run_(run), march_(march) {}

  [[nodiscard]] bool admit(Index3 window, std::uint64_t bytes, const MostBytes& most) override {
    return run_.admit({march_, window}, bytes, most);
  }
  [[nodiscard]] std::vector<std::optional<BlockMesh>> take(Index3 window) override {
    // The next window of its row cannot start before this one ends, and may start right then.
    run_.prefetch({march_, window + Index3{1, 0, 0}});
    return run_.take({march_, window});
  }
  void commit(Index3 window, std::vector<BlockMesh> blocks) override {
    run_.commit({march_, window}, std::move(blocks));
  }
  [[nodiscard]] BlockMesh load(Index3 block) const override { return run_.load({march_, block}); }
  [[nodiscard]] bool is_done(Index3 window) const override {
    return run_.is_done({march_, window});
  }
  [[nodiscard]] std::uint64_t taken_bytes(Index3 window) const override {
    return run_.memory_bytes_of(run_.layout_.blocks_of({march_, window}));
  }
  [[nodiscard]] std::uint64_t loaded_bytes(Index3 block) const override {
    const BlockKey key{march_, block};
    return run_.memory_bytes_of({&key, 1});
  }

 private:
  RunStore& run_;
  std::uint32_t march_;
};

// More than five parameters: each is an object of another room, and three may be missing.
RunStore::RunStore(const RunLayout& layout, MemoryBudget& budget, WorkFiles* files,
                   const GroupCommit& group, BlockRouter* router, BlockKeeper* keeper)
    : layout_(layout),
      budget_(budget),
      limits_(group),
      router_(router),
      keeper_(keeper),
      index_room_(budget.reserve(
          Purpose::kIndex, router == nullptr ? index_bytes(layout) : least_index_bytes(layout))),
      done_(layout.windows()),
      disk_(open_disk(files, keeper)),
      table_(layout, done_, disk_.get(), router == nullptr ? TableRoom() : room_for_index()) {
  for (std::uint32_t m = 0; m < layout.marches(); ++m) {
    marches_.push_back(std::make_unique<March>(*this, m));
  }
  if (files == nullptr) return;
  journal_ = std::make_unique<Journal>(files->open(kJournalFile));
  restore();
}

RunStore::~RunStore() = default;

void RunStore::restore() {
  journal_->replay([&](const JournalRecord& record) {
    for (const JournalBlock& block : record.blocks) {
      if (block.slot >= layout_.slots())
        throw DamagedWork("journal", "it has a block that there is not");
      table_.restore(block);
    }
    for (std::uint64_t window : record.windows) {
      if (window >= layout_.windows())
        throw DamagedWork("journal", "it has a window that there is not");
      done_.insert(window);
    }
  });
  table_.take_extents();
  resumed_windows_ = done_.count();
}

BlockStore& RunStore::march(std::uint32_t march) {
  return *marches_[march];
}

void RunStore::find(const BlockKey& key, std::vector<Source>& out) const {
  const StoredBlock& block = table_.at(layout_.slot(key));
  if (!block.empty()) {
    out.push_back({key, block.cached, block.extent(), block.sum});
    if (block.kept) out.back().kept = block.place();
  } else if (key.march > 0) {
    for (const BlockKey& part : layout_.parts(key)) find(part, out);
  }
}

BlockMesh RunStore::read(const Source& source) const {
  if (source.cached != nullptr) return decode_block(source.key, source.cached->bytes);
  if (source.kept) {
    bytes_read_ += source.kept->size;
    return decode_block(source.key, keeper_->read(source.key, *source.kept));
  }
  BlockMesh mesh;
  disk_->read(source.extent, [&](std::span<const std::byte> bytes) {
    if (bytes.size() < 8 || sum_of(bytes) != source.sum) {
      throw DamagedWork(name(source.key), "these are not the bytes that were written");
    }
    mesh = decode_block(source.key, bytes);
  });
  bytes_read_ += source.extent.size;
  return mesh;
}

std::optional<BlockMesh> RunStore::assemble(const BlockKey& key,
                                            const std::vector<Source>& sources) const {
  if (sources.empty()) return std::nullopt;
  if (sources.size() == 1 && sources.front().key == key) return read(sources.front());
  std::vector<BlockMesh> parts;
  for (const Source& source : sources) {
    parts.push_back(layout_.moved(read(source), source.key, key));
  }
  return merge_blocks(std::move(parts));
}

std::vector<std::optional<BlockMesh>> RunStore::take(const WindowKey& key) const {
  std::vector<std::vector<Source>> sources;
  {
    const std::lock_guard lock(mutex_);
    for (const BlockKey& block : layout_.blocks_of(key)) find(block, sources.emplace_back());
  }
  std::vector<std::optional<BlockMesh>> out;
  const std::vector<BlockKey> blocks = layout_.blocks_of(key);
  for (std::size_t i = 0; i < blocks.size(); ++i) out.push_back(assemble(blocks[i], sources[i]));
  return out;
}

BlockMesh RunStore::load(const BlockKey& key) const {
  std::vector<Source> sources;
  {
    const std::lock_guard lock(mutex_);
    find(key, sources);
  }
  MW_ASSERT(!sources.empty());
  return assemble(key, sources).value();
}

bool RunStore::is_done(const WindowKey& key) const {
  const std::lock_guard lock(mutex_);
  return done_.contains(layout_.window(key));
}

std::uint64_t RunStore::memory_bytes_of(std::span<const BlockKey> keys) const {
  const std::lock_guard lock(mutex_);
  std::vector<Source> sources;
  for (const BlockKey& key : keys) find(key, sources);
  std::uint64_t sum = 0;
  for (const Source& s : sources) {
    sum += std::uint64_t{table_.at(layout_.slot(s.key)).memory_kib} * 1024;
  }
  return sum;
}

void RunStore::prefetch(const WindowKey& key) const {
  if (disk_ == nullptr || key.window.x >= layout_.grid(key.march).windows().x) return;
  std::vector<Source> sources;
  {
    const std::lock_guard lock(mutex_);
    for (const BlockKey& block : layout_.blocks_of(key)) find(block, sources);
  }
  for (const Source& s : sources) {
    if (s.cached == nullptr && !s.kept) disk_->prefetch(s.extent);
  }
}

std::optional<MemoryBudget::Reservation> RunStore::try_reserve(Purpose purpose,
                                                               std::uint64_t bytes) {
  if (budget_.min_with(bytes) > budget_.limit()) return std::nullopt;
  for (;;) {
    if (auto reserved = budget_.try_reserve(purpose, bytes)) return reserved;
    const std::lock_guard lock(mutex_);
    if (!table_.evict_one()) return std::nullopt;
  }
}

MemoryBudget::Reservation RunStore::reserve(Purpose purpose, std::uint64_t bytes, double grows) {
  auto reserved = try_reserve(purpose, bytes);
  if (!reserved) budget_.fail(bytes, grows);
  return std::move(*reserved);
}

TableRoom RunStore::room_for_index() {
  return [this](std::uint64_t bytes) {
    for (;;) {
      if (auto reserved = budget_.try_reserve(Purpose::kIndex, bytes)) return std::move(*reserved);
      if (!table_.evict_one()) budget_.fail(bytes);
    }
  };
}

/// An eighth is added for the holes that blocks of all sizes leave in the heap as they come and go:
/// without it a run of a gigavoxel (280,000 windows) held 198 MiB under a budget of 192.
std::uint64_t RunStore::cost_of(std::uint64_t encoded_bytes) {
  return encoded_bytes + encoded_bytes / 8 + kBytesPerBlock;
}

BlockPin RunStore::encode(const BlockKey& key, const BlockMesh& mesh,
                          MemoryBudget::Reservation& room) {
  std::vector<std::byte> encoded = encode_block(key, mesh);
  const std::uint64_t bytes = cost_of(encoded.size());
  auto own = room.bytes() >= bytes ? budget_.carve(room, Purpose::kBlocks, bytes)
                                   : reserve(Purpose::kBlocks, bytes);
  return pin_of(std::move(encoded), memory_bytes(mesh), std::move(own));
}

/// True if a window in flight, or a block on its way, holds memory that it will give back.  Then
/// the march asks again.
bool RunStore::will_give_back() const {
  {
    const std::lock_guard lock(mutex_);
    if (!in_flight_.empty() || (router_ != nullptr && visiting_ > 0)) return true;
  }
  return router_ != nullptr && router_->is_carrying();
}

bool RunStore::admit(const WindowKey& key, std::uint64_t bytes, const MostBytes& most) {
  // This is asked first, since what is given back while room is sought may come too late for it.
  const bool may_ask_again = will_give_back();
  auto room = try_reserve(Purpose::kWindows, bytes);
  {
    const std::lock_guard lock(mutex_);
    if (paused_) return false;
    if (room) {
      ++visiting_;
      in_flight_.emplace(layout_.window(key), std::move(*room));
      return true;
    }
  }
  if (!may_ask_again && !will_give_back()) budget_.fail(most ? std::max(bytes, most()) : bytes);
  return false;
}

void RunStore::commit(const WindowKey& key, std::vector<BlockMesh> blocks) {
  const std::vector<BlockKey> keys = layout_.blocks_of(key);
  MW_ASSERT(blocks.size() == keys.size());
  MemoryBudget::Reservation room;
  {
    const std::lock_guard lock(mutex_);
    const auto admitted = in_flight_.find(layout_.window(key));
    if (admitted != in_flight_.end()) room = std::move(admitted->second);
  }
  std::vector<BlockPin> pins;
  std::vector<LeftBlock> left;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    pins.push_back(encode(keys[i], blocks[i], room));
    if (keeper_ != nullptr) {
      left.push_back({pins[i]->bytes, pins[i]->memory_bytes, voxels_of(blocks[i])});
    }
    blocks[i] = {};
  }
  std::vector<KeptPlace> places;
  if (keeper_ != nullptr) places = keeper_->keep(key, left);
  room = {};
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    replace(key, keys, pins, places);
    in_flight_.erase(layout_.window(key));  // all that it held can be spilled from here on
    full = router_ == nullptr && group_is_full();
  }
  if (router_ != nullptr) send_away(key, keys, std::move(pins));
  if (!full) return;
  const std::unique_lock turn(saving_, std::try_to_lock);  // if it fails, another thread saves
  if (turn.owns_lock()) write_group();
}

/// The blocks leave the table under their old turns, the window is done, and those whose next user
/// is here enter it again.
void RunStore::replace(const WindowKey& key, std::span<const BlockKey> blocks,
                       std::vector<BlockPin>& pins, std::span<const KeptPlace> places) {
  const bool was_torn = std::exchange(torn_, true);
  std::vector<std::uint64_t> slots;
  for (const BlockKey& block : blocks) {
    slots.push_back(layout_.slot(block));
    if (block.march > 0 && table_.at(slots.back()).empty()) {
      for (const BlockKey& part : layout_.parts(block)) {
        table_.remove(layout_.slot(part));
        if (router_ != nullptr) group_.slots.push_back(layout_.slot(part));
      }
    }
    table_.remove(slots.back());
  }
  done_.insert(layout_.window(key));
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (!stays(key, blocks[i])) continue;
    if (!places.empty() && (pins.empty() || places[i].size > 0)) {
      table_.put_kept(slots[i], places[i], pins.empty() ? nullptr : std::move(pins[i]));
    } else {
      table_.put(slots[i], std::move(pins[i]));
    }
  }
  if (journal_ != nullptr) {
    group_.windows.push_back(layout_.window(key));
    group_.slots.insert(group_.slots.end(), slots.begin(), slots.end());
  }
  torn_ = was_torn;
}

void RunStore::adopt(const WindowKey& key, std::span<const KeptPlace> places) {
  const std::vector<BlockKey> keys = layout_.blocks_of(key);
  MW_ASSERT(places.size() == keys.size());
  std::vector<BlockPin> none;
  const std::lock_guard lock(mutex_);
  replace(key, keys, none, places);
}

/// A pin is null if its block is in the table.
void RunStore::send_away(const WindowKey& key, std::span<const BlockKey> blocks,
                         std::vector<BlockPin> pins) {
  std::vector<BlockVersion> here;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BlockVersion version{blocks[i], key};
    if (pins[i] == nullptr) {
      here.push_back(version);
    } else {
      router_->send(version, std::move(pins[i]));
    }
  }
  router_->committed(here);
  const std::lock_guard lock(mutex_);
  --visiting_;
}

/// The windows over the block up to the one that left it count as done, whichever process visited
/// them, so that the block's turn is that of the window that waits for it.
void RunStore::receive(const BlockVersion& version, std::vector<std::byte> bytes,
                       std::uint64_t memory_bytes, MemoryBudget::Reservation room) {
  const std::uint64_t needed = cost_of(bytes.size());
  if (room.bytes() < needed) {
    room = try_reserve(Purpose::kBlocks, needed).value_or(MemoryBudget::Reservation());
  }
  const bool fits = room.bytes() >= needed;
  if (!fits && disk_ == nullptr) budget_.fail(needed);
  BlockPin pin = pin_of(std::move(bytes), memory_bytes, std::move(room));
  if (keeper_ != nullptr) {
    const Box3 voxels = voxels_of(decode_block(version.block, pin->bytes));
    keeper_->receive(version.block, {pin->bytes, memory_bytes, voxels});
  }
  const WindowOrder order = layout_.order(version.block.march);
  const std::uint64_t from = order.rank(version.from.window);
  const std::lock_guard lock(mutex_);
  const bool was_torn = std::exchange(torn_, true);
  for_each_index(layout_.windows_over(version.block), [&](Index3 w) {
    if (order.rank(w) <= from) done_.insert(layout_.window({version.block.march, w}));
  });
  table_.put(layout_.slot(version.block), std::move(pin));
  if (!fits) table_.evict(layout_.slot(version.block));
  if (journal_ != nullptr) group_.slots.push_back(layout_.slot(version.block));
  torn_ = was_torn;
}

}  // namespace mw::engine
