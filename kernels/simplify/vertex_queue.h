// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The order of contraction: vertices in coarse cost buckets, each drained in id order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// A queue of vertices keyed by the cost of their cheapest edge.
///
/// Sec 5.2 contracts the cheapest edge first.  Here costs fall into buckets with bounds
/// 0.125 * 4^k, and a bucket is drained in rounds of ascending vertex id: no stale entries, walks
/// that stay in the cache, and an order that depends on the content only, never on who pushed
/// first.  (Strict order is 2-3 times slower for the same mesh size.)
class VertexQueue {
 public:
  static constexpr std::size_t kBuckets = 12;
  /// Upper bound of the costs in bucket k.
  [[nodiscard]] static constexpr double bound(std::size_t bucket) {
    return 0.125 * static_cast<double>(std::size_t{1} << (2 * bucket));
  }

  /// Files v under the bucket of `cost`, but not below the bucket being drained.  Costs above the
  /// last bound are not contracted at all: v is forgotten.
  void push(LocalVertex v, double cost) {
    std::size_t bucket = current_;
    while (bucket < kBuckets && cost > bound(bucket)) ++bucket;
    if (bucket < kBuckets) buckets_[bucket].push_back(v);
  }

  /// Takes the next round: every vertex now in the lowest non-empty bucket, ascending, once.
  /// ENSURES: false when the queue is empty.
  bool take_round(std::vector<LocalVertex>& round) {
    round.clear();
    while (current_ < kBuckets && buckets_[current_].empty()) ++current_;
    if (current_ == kBuckets) return false;
    round.swap(buckets_[current_]);
    std::sort(round.begin(), round.end());
    round.erase(std::unique(round.begin(), round.end()), round.end());
    return true;
  }

  /// Bound of the bucket that the last round came from.
  [[nodiscard]] double current_bound() const { return bound(current_); }

 private:
  std::array<std::vector<LocalVertex>, kBuckets> buckets_;
  std::size_t current_ = 0;
};

}  // namespace mw
