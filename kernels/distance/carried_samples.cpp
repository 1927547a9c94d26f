// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Linear probing with removal by shifting back; lists that grow move to the end of the pool.
#include "kernels/distance/carried_samples.h"

#include <utility>

#include "kernels/core/assert.h"

namespace mw {
namespace {

constexpr std::size_t kFirstSlots = 64;
constexpr std::size_t kFirstPool = 256;

/// Replaces ==, which is a call to memcmp.
bool is_same(const TriangleKey& a, const TriangleKey& b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

}  // namespace

std::size_t CarriedSamples::home(const TriangleKey& key) const {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;
  std::uint64_t h = (std::uint64_t{key[0]} << 32 | key[1]) * kOdd;
  h = (h ^ h >> 29 ^ key[2]) * kOdd;
  return static_cast<std::size_t>(h ^ h >> 32) & (slots_.size() - 1);
}

std::size_t CarriedSamples::find(const TriangleKey& key) const {
  std::size_t at = home(key);
  while (slots_[at].list.size != 0 && !is_same(slots_[at].key, key)) {
    at = (at + 1) & (slots_.size() - 1);
  }
  return at;
}

/// Returns the slot of the triangle and makes one if there is none; the caller fills its list.
CarriedSamples::Slot& CarriedSamples::open(const TriangleKey& key, Label side) {
  if (2 * (used_ + 1) > slots_.size()) grow();
  Slot& slot = slots_[find(key)];
  if (slot.list.size == 0) {
    slot = {key, {.side = side}};
    ++used_;
  }
  return slot;
}

void CarriedSamples::add(const TriangleKey& key, Label side, FaceSamples sample) {
  if (pool_.size() > kFirstPool && pool_.size() > 2 * live_) compact();
  Taken& list = open(key, side).list;
  make_room(list);
  pool_[list.begin + list.size++] = sample;
}

/// Makes sure that the list has room for one more sample.
void CarriedSamples::make_room(Taken& list) {
  if (list.size < list.capacity) return;
  const bool is_last = list.capacity > 0 && list.begin + list.capacity == pool_.size();
  const std::uint32_t more = is_last || list.size == 0 ? 1 : 1 + list.size / 2;
  if (!is_last) {
    const auto begin = static_cast<std::uint32_t>(pool_.size());
    pool_.resize(pool_.size() + list.size);
    std::copy_n(pool_.begin() + list.begin, list.size, pool_.begin() + begin);
    live_ -= list.capacity - list.size;
    list.begin = begin;
    list.capacity = list.size;
  }
  pool_.resize(pool_.size() + more);
  list.capacity += more;
  live_ += more;
}

/// Drops the parts of the pool that belong to no list.
void CarriedSamples::compact() {
  std::vector<FaceSamples> pool;
  pool.reserve(live_ + live_ / 2);
  for (Slot& slot : slots_) {
    Taken& list = slot.list;
    if (list.size == 0) continue;
    const auto begin = static_cast<std::uint32_t>(pool.size());
    pool.insert(pool.end(), pool_.begin() + list.begin, pool_.begin() + list.begin + list.size);
    list.begin = begin;
    list.capacity = list.size;
  }
  pool_ = std::move(pool);
  live_ = pool_.size();
}

CarriedSamples::Taken CarriedSamples::take(const TriangleKey& key) {
  if (used_ == 0) return {};
  const std::size_t at = find(key);
  const Taken list = slots_[at].list;
  if (list.size == 0) return {};
  live_ -= list.capacity;
  --used_;
  close_gap(at);
  return list;
}

void CarriedSamples::give(const TriangleKey& key, const Taken& list) {
  if (list.size == 0) return;
  Taken& own = open(key, list.side).list;
  if (own.size == 0) {
    own = list;
    live_ += list.capacity;
    return;
  }
  for (std::uint32_t i = 0; i < list.size; ++i) {
    make_room(own);
    pool_[own.begin + own.size++] = pool_[list.begin + i];
  }
}

void CarriedSamples::keep(const TriangleKey& key, const std::vector<bool>& kept) {
  if (used_ == 0) return;
  const std::size_t at = find(key);
  Taken& list = slots_[at].list;
  MW_ASSERT(kept.size() == list.size);
  std::uint32_t left = 0;
  for (std::uint32_t i = 0; i < list.size; ++i) {
    if (kept[i]) pool_[list.begin + left++] = pool_[list.begin + i];
  }
  const bool was_there = list.size > 0;
  list.size = left;
  if (left > 0 || !was_there) return;
  live_ -= list.capacity;
  --used_;
  close_gap(at);
}

/// Moves later slots of the run back, so that no search stops short of them.
void CarriedSamples::close_gap(std::size_t gap) {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = (gap + 1) & mask; slots_[at].list.size != 0; at = (at + 1) & mask) {
    const std::size_t wanted = home(slots_[at].key);
    if (((at - wanted) & mask) < ((at - gap) & mask)) continue;
    slots_[gap] = slots_[at];
    gap = at;
  }
  slots_[gap].list = {};
}

void CarriedSamples::grow() {
  const std::vector<Slot> old =
      std::exchange(slots_, std::vector<Slot>(std::max(kFirstSlots, 2 * slots_.size())));
  for (const Slot& slot : old) {
    if (slot.list.size != 0) slots_[find(slot.key)] = slot;
  }
}

}  // namespace mw
