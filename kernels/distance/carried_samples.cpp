// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Linear probing with removal by shifting back; a free list of nodes.
#include "kernels/distance/carried_samples.h"

#include <utility>

namespace mw {
namespace {

constexpr std::size_t kFirstSlots = 64;

/// As ==, which is a call to memcmp.
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
  while (slots_[at].head != kNone && !is_same(slots_[at].key, key)) {
    at = (at + 1) & (slots_.size() - 1);
  }
  return at;
}

void CarriedSamples::add(const TriangleKey& key, Label side, FaceSamples sample) {
  if (2 * (used_ + 1) > slots_.size()) grow();
  Slot& slot = slots_[find(key)];
  if (slot.head == kNone) {
    slot = {key, side, kNone};
    ++used_;
  }
  std::uint32_t node = free_nodes_;
  if (node == kNone) {
    node = static_cast<std::uint32_t>(pool_.size());
    pool_.emplace_back();
  } else {
    free_nodes_ = pool_[node].next;
  }
  pool_[node] = {sample, slot.head};
  slot.head = node;
}

void CarriedSamples::erase(const TriangleKey& key) {
  if (used_ == 0) return;
  const std::size_t at = find(key);
  if (slots_[at].head == kNone) return;
  std::uint32_t last = slots_[at].head;
  while (pool_[last].next != kNone) last = pool_[last].next;
  pool_[last].next = free_nodes_;
  free_nodes_ = slots_[at].head;
  --used_;
  close_gap(at);
}

/// Moves later slots of the run back, so that no search stops short of them.
void CarriedSamples::close_gap(std::size_t gap) {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = (gap + 1) & mask; slots_[at].head != kNone; at = (at + 1) & mask) {
    const std::size_t wanted = home(slots_[at].key);
    if (((at - wanted) & mask) < ((at - gap) & mask)) continue;
    slots_[gap] = slots_[at];
    gap = at;
  }
  slots_[gap].head = kNone;
}

void CarriedSamples::grow() {
  const std::vector<Slot> old =
      std::exchange(slots_, std::vector<Slot>(std::max(kFirstSlots, 2 * slots_.size())));
  for (const Slot& slot : old) {
    if (slot.head != kNone) slots_[find(slot.key)] = slot;
  }
}

}  // namespace mw
