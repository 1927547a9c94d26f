// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the chunks that were asked for last.
#include "io/chunks/chunked_volume.h"

#include <algorithm>

namespace mw::io {
namespace {

/// The bytes that a kept chunk costs beside its voxels, for two nodes and a slot.
constexpr std::uint64_t kOverhead = 256;
/// The most files that hold chunks at a time, since a process has few descriptors.
constexpr std::uint64_t kMaxFiles = 256;

std::uint64_t cost_of(const Chunk& chunk, std::uint64_t max) {
  return kOverhead + std::max(chunk.size(), chunk.file ? max / kMaxFiles : 0);
}

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

/// Counts a loaded chunk, and drops the oldest until the bound holds.  The entry may be gone, or
/// belong to another slot.
void ChunkCache::account(std::uint64_t number, const std::shared_ptr<Slot>& slot) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(number);
  if (found == entries_.end() || found->second.slot != slot) return;
  found->second.bytes = slot->chunk ? cost_of(*slot->chunk, max_bytes_) : kOverhead;
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

}  // namespace mw::io
