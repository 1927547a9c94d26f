// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads regions of a volume from its chunks.
#include "io/chunks/chunked_volume.h"

#include <algorithm>

#include "io/file/errors.h"
#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

/// What a chunk costs beside its voxels: two nodes and a slot.
constexpr std::uint64_t kOverhead = 256;

}  // namespace

ChunkCache::Loaded ChunkCache::get(std::uint64_t number,
                                   const std::function<std::optional<Chunk>()>& load) {
  const std::shared_ptr<Slot> slot = touch(number);
  const std::lock_guard lock(slot->loading);
  if (slot->loaded) return slot->chunk;
  try {
    if (std::optional<Chunk> chunk = load()) {
      slot->chunk = std::make_shared<const Chunk>(std::move(*chunk));
    }
  } catch (...) {
    forget(number, slot);
    throw;
  }
  slot->loaded = true;
  account(number, slot);
  return slot->chunk;
}

void ChunkCache::clear() {
  const std::lock_guard lock(mutex_);
  entries_.clear();
  ages_.clear();
  bytes_ = 0;
}

std::shared_ptr<ChunkCache::Slot> ChunkCache::touch(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(number);
  if (found != entries_.end()) {
    ages_.splice(ages_.begin(), ages_, found->second.age);
    return found->second.slot;
  }
  ages_.push_front(number);
  return entries_.emplace(number, Entry{std::make_shared<Slot>(), ages_.begin()})
      .first->second.slot;
}

/// Counts what was loaded, and makes room for it.  The entry may be gone, or be another one by now.
void ChunkCache::account(std::uint64_t number, const std::shared_ptr<Slot>& slot) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(number);
  if (found == entries_.end() || found->second.slot != slot) return;
  found->second.bytes = kOverhead + (slot->chunk ? slot->chunk->bytes.size() : 0);
  bytes_ += found->second.bytes;
  while (bytes_ > max_bytes_ && !ages_.empty()) {
    const auto oldest = entries_.find(ages_.back());
    bytes_ -= oldest->second.bytes;
    entries_.erase(oldest);
    ages_.pop_back();
  }
}

void ChunkCache::forget(std::uint64_t number, const std::shared_ptr<Slot>& slot) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(number);
  if (found == entries_.end() || found->second.slot != slot) return;
  ages_.erase(found->second.age);
  entries_.erase(found);
}

namespace {

/// Whether the bytes hold every voxel that the strides lead to.
bool holds(const Chunk& chunk, Index3 shape, VoxelType type) {
  const std::size_t voxels = chunk.bytes.size() / static_cast<std::size_t>(byte_size(type));
  if (chunk.strides.x < 0 || chunk.strides.y < 0 || chunk.strides.z < 0) return false;
  const auto last =
      static_cast<std::size_t>((shape.x - 1) * chunk.strides.x + (shape.y - 1) * chunk.strides.y +
                               (shape.z - 1) * chunk.strides.z);
  return chunk.first + last < voxels;
}

}  // namespace

ChunkedVolume::ChunkedVolume(VolumeInfo info, VoxelCoding coding, RawLabel fill,
                             std::unique_ptr<ChunkSource> source, std::uint64_t cache_bytes)
    : info_(std::move(info)),
      coding_(coding),
      fill_(fill),
      source_(std::move(source)),
      cache_bytes_(cache_bytes),
      cache_(cache_bytes) {
  MW_ASSERT(info_.chunk.x > 0 && info_.chunk.y > 0 && info_.chunk.z > 0);
}

Box3 ChunkedVolume::box_of(Index3 chunk) const {
  const Index3 c = info_.chunk;
  const Index3 lo{chunk.x * c.x, chunk.y * c.y, chunk.z * c.z};
  return intersection({lo, lo + c}, {{0, 0, 0}, info_.shape});
}

ChunkCache::Loaded ChunkedVolume::load(Index3 chunk) const {
  const Box3 grid = cells_of({{0, 0, 0}, info_.shape}, info_.chunk);
  return cache_.get(static_cast<std::uint64_t>(grid.offset(chunk)), [&] {
    const Box3 box = box_of(chunk);
    std::optional<Chunk> loaded = source_->load(chunk, box);
    if (loaded && !holds(*loaded, box.shape(), coding_.type)) {
      fail_input(source_->name_of(chunk), {}, "the chunk is too short for its voxels",
                 "get a whole copy of the store");
    }
    return loaded;
  });
}

void ChunkedVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  if (out.empty()) return;
  for_each_index(cells_of(box, info_.chunk), [&](Index3 number) {
    const Box3 held = box_of(number);
    const Box3 part = intersection(held, box);
    if (const ChunkCache::Loaded chunk = load(number)) return copy(*chunk, held, part, box, out);
    for (Index3 v = part.lo; v.z < part.hi.z; ++v.z) {
      for (v.y = part.lo.y; v.y < part.hi.y; ++v.y) {
        std::fill_n(out.data() + box.offset({part.lo.x, v.y, v.z}), part.shape().x, fill_);
      }
    }
  });
}

void ChunkedVolume::copy(const Chunk& chunk, const Box3& held, const Box3& part, const Box3& box,
                         std::span<RawLabel> out) const {
  const auto size = static_cast<std::size_t>(byte_size(coding_.type));
  const auto length = static_cast<std::size_t>(part.shape().x);
  for (Index3 v = part.lo; v.z < part.hi.z; ++v.z) {
    for (v.y = part.lo.y; v.y < part.hi.y; ++v.y) {
      const Index3 inside = Index3{part.lo.x, v.y, v.z} - held.lo;
      const auto at = static_cast<std::size_t>(
          inside.x * chunk.strides.x + inside.y * chunk.strides.y + inside.z * chunk.strides.z);
      const std::byte* bytes = chunk.bytes.data() + (chunk.first + at) * size;
      const auto step = static_cast<std::size_t>(chunk.strides.x);
      const std::size_t good = decode_voxels(bytes, length, step, coding_,
                                             out.data() + box.offset({part.lo.x, v.y, v.z}), 1);
      if (good == length) continue;
      fail_voxel(source_->name(), {part.lo.x + static_cast<std::int64_t>(good), v.y, v.z},
                 bytes + good * step * size, coding_);
    }
  }
}

std::uint64_t ChunkedVolume::buffer_bytes(int threads) const {
  const auto chunk = static_cast<std::uint64_t>(info_.chunk.product()) *
                     static_cast<std::uint64_t>(byte_size(coding_.type));
  return cache_bytes_ + static_cast<std::uint64_t>(threads) * (chunk + source_->scratch_bytes());
}

}  // namespace mw::io
