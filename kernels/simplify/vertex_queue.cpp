// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A push sets a bit, a round takes words of them.  The header argues why the memory orders suffice.
#include "kernels/simplify/vertex_queue.h"

#include <algorithm>
#include <bit>

namespace mw {
namespace {

constexpr std::size_t kWordBits = 64;

/// Counts bounds instead of searching, because no branch predictor can tell the bucket.
std::size_t bucket_of(double cost) {
  std::size_t bucket = 0;
  for (std::size_t k = 0; k < VertexQueue::kBuckets; ++k) {
    bucket += cost > VertexQueue::bound(k) ? 1U : 0U;
  }
  return bucket;
}

void append_bits(std::uint64_t bits, std::size_t first, std::vector<LocalVertex>& out) {
  for (; bits != 0; bits &= bits - 1) {
    out.push_back(
        static_cast<LocalVertex>(first + static_cast<std::size_t>(std::countr_zero(bits))));
  }
}

}  // namespace

VertexQueue::VertexQueue(LocalVertex vertex_count)
    : words_((vertex_count + kWordBits - 1) / kWordBits), bits_(kBuckets * words_) {}

void VertexQueue::push(LocalVertex v, double cost) {
  const std::size_t bucket = bucket_of(cost);
  if (bucket == kBuckets) return;
  const std::uint64_t bit = std::uint64_t{1} << (v % kWordBits);
  word(bucket, v / kWordBits).fetch_or(bit, std::memory_order_release);
}

bool VertexQueue::take_round(std::vector<LocalVertex>& round) {
  round.clear();
  std::size_t lowest = 0;
  while (lowest < kBuckets && is_empty(lowest)) ++lowest;
  if (lowest == kBuckets) return false;
  current_ = std::max(current_, lowest);
  for (std::size_t i = 0; i < words_; ++i) append_bits(take_word(i), i * kWordBits, round);
  return true;
}

bool VertexQueue::is_empty(std::size_t bucket) const {
  const auto first = bits_.begin() + static_cast<std::ptrdiff_t>(bucket * words_);
  return std::all_of(first, first + static_cast<std::ptrdiff_t>(words_),
                     [](const Word& w) { return w.load(std::memory_order_relaxed) == 0; });
}

/// Takes the vertices of word i out of all buckets up to the current one.
std::uint64_t VertexQueue::take_word(std::size_t i) {
  std::uint64_t bits = 0;
  for (std::size_t bucket = 0; bucket <= current_; ++bucket) {
    Word& w = word(bucket, i);
    if (w.load(std::memory_order_relaxed) != 0) bits |= w.exchange(0, std::memory_order_acquire);
  }
  return bits;
}

}  // namespace mw
