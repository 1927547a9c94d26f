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

/// Direct-mapped, of a size that follows from the mesh's and stays in the cache: a lost entry costs
/// one more try, and the same one in every run.
class FailedPairs {
 public:
  explicit FailedPairs(std::size_t vertices)
      : entries_(std::bit_ceil(std::clamp(4 * vertices, kLeast, kMost))),
        shift_(64 - std::countr_zero(entries_.size())) {}

  [[nodiscard]] bool contains(const TetMesh& mesh, LocalVertex p, LocalVertex q) const {
    return entries_[slot(p, q)] == entry(mesh, p, q);
  }
  void insert(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    entries_[slot(p, q)] = entry(mesh, p, q);
  }

 private:
  static constexpr std::size_t kLeast = std::size_t{1} << 6;
  static constexpr std::size_t kMost = std::size_t{1} << 14;
  struct Entry {
    LocalVertex p = 0, q = 0;
    std::uint32_t version_p = 0, version_q = 0;
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  [[nodiscard]] std::size_t slot(LocalVertex p, LocalVertex q) const {
    const std::uint64_t key = std::uint64_t{std::min(p, q)} << 32 | std::max(p, q);
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15ULL >> shift_);
  }
  static Entry entry(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    if (p > q) std::swap(p, q);
    return {p, q, mesh.version(p), mesh.version(q)};
  }

  std::vector<Entry> entries_;
  int shift_;
};

}  // namespace mw
