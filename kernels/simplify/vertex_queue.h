// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The order of contraction: a lock-free queue of cost buckets, each drained in vertex order.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// A queue of vertices keyed by the cost of their cheapest edge: many producers, one owner.
///
/// Sec 5.2 contracts the cheapest edge first.  Here costs fall into buckets with bounds
/// 0.125 * 4^k, and a bucket is drained in rounds of ascending vertex id.  Such walks stay in the
/// cache, and their order depends on the content only, never on who pushed first.  (Strict order is
/// 2-3 times slower for the same mesh size.)
///
/// A bucket is a bitmap over the window's vertices.  A push is one atomic OR into it, which is
/// wait-free and allocates nothing; a vertex that is pushed twice is there once.  Because OR
/// commutes, the bitmaps after a set of pushes are the same for every interleaving of them; the
/// owner reads them in vertex order.  A push removes nothing: a vertex whose cost has changed lies
/// in several buckets, and the owner finds out when it gets there.
///
/// Memory orders.  All accesses to a word are read-modify-writes, except a look that only decides
/// whether to skip an empty word.  So no bit is lost: each is returned by exactly one exchange.
/// Pushes release and the exchange acquires; the ORs between them continue the release sequence,
/// hence the owner sees all that every producer did before it pushed.  A push that happened before
/// take_round() is seen by it, because a look cannot read an older value of the word than one that
/// happened before it (coherence).
///
/// Thread safety: push() from any number of threads at any time; the rest from the owner alone.
/// Cost: kBuckets bits a vertex; a push O(1); a round one look at each 64 vertices a bucket.
class VertexQueue {
 public:
  static constexpr std::size_t kBuckets = 12;
  /// Upper bound of the costs in bucket k.
  [[nodiscard]] static constexpr double bound(std::size_t bucket) {
    return 0.125 * static_cast<double>(std::size_t{1} << (2 * bucket));
  }

  /// A queue for vertices 0 to vertex_count - 1.
  explicit VertexQueue(LocalVertex vertex_count);

  /// Files v under the bucket of `cost`.  Forgets v if the cost is above the last bound, as such
  /// edges are not contracted at all.  REQUIRES: v < vertex_count.
  void push(LocalVertex v, double cost);

  /// Takes the next round, which is the lowest bucket that is not empty: its vertices ascend, each
  /// once.  A bucket below the one being drained joins that, so that bounds never go down.
  /// ENSURES: false when there is nothing left.  What was pushed before the call is considered;
  /// what is pushed during the call comes in this round or a later one.
  bool take_round(std::vector<LocalVertex>& round);

  /// Bound of the bucket that the last round came from.
  [[nodiscard]] double current_bound() const { return bound(current_); }

 private:
  using Word = std::atomic<std::uint64_t>;
  static_assert(Word::is_always_lock_free);

  [[nodiscard]] Word& word(std::size_t bucket, std::size_t i) { return bits_[bucket * words_ + i]; }
  [[nodiscard]] bool is_empty(std::size_t bucket) const;
  [[nodiscard]] std::uint64_t take_word(std::size_t i);

  std::size_t words_;       ///< words in each bucket
  std::vector<Word> bits_;  ///< bucket by bucket; bit v % 64 of word v / 64 stands for v
  std::size_t current_ = 0;
};

}  // namespace mw
