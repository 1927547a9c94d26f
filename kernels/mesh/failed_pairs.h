// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edges that were tried in vain, until one of their ends changes.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// A direct-mapped table whose size follows from the mesh's and stays in the cache.  A lost entry
/// costs one more try, and the same one in every run.  An entry is a hash of the edge and the
/// versions of its ends; one look in two thousand million takes another edge's for it and spares a
/// try that was due.
class FailedPairs {
 public:
  explicit FailedPairs(std::size_t vertices)
      : entries_(std::bit_ceil(std::clamp(4 * vertices, kMin, kMax))),
        shift_(64 - std::countr_zero(entries_.size())) {}

  [[nodiscard]] bool contains(const TetMesh& mesh, LocalVertex p, LocalVertex q) const {
    return entries_[slot(p, q)] == entry(mesh, p, q);
  }
  void insert(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    entries_[slot(p, q)] = entry(mesh, p, q);
  }

 private:
  static constexpr std::size_t kMin = std::size_t{1} << 6;
  static constexpr std::size_t kMax = std::size_t{1} << 14;
  static constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;

  static std::uint64_t key(std::uint32_t low, std::uint32_t high) {
    return (std::uint64_t{low} << 32 | high) * kOdd;
  }
  [[nodiscard]] std::size_t slot(LocalVertex p, LocalVertex q) const {
    return static_cast<std::size_t>(key(std::min(p, q), std::max(p, q)) >> shift_);
  }
  /// Never 0, which stands for none.
  static std::uint32_t entry(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    if (p > q) std::swap(p, q);
    std::uint64_t hash = key(p, q) ^ (key(mesh.version(p), mesh.version(q)) >> 1);
    hash = (hash ^ hash >> 29) * kOdd;
    return static_cast<std::uint32_t>(hash >> 32) | 1U;
  }

  std::vector<std::uint32_t> entries_;
  int shift_;
};

}  // namespace mw
