// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edges that were tried in vain, until one of their ends changes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Direct-mapped and of fixed size, so that it stays in the cache: a lost entry costs one more try,
/// and the same one in every run.
class FailedPairs {
 public:
  FailedPairs() : entries_(kSize) {}

  [[nodiscard]] bool contains(const TetMesh& mesh, LocalVertex p, LocalVertex q) const {
    return entries_[slot(p, q)] == entry(mesh, p, q);
  }
  void insert(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    entries_[slot(p, q)] = entry(mesh, p, q);
  }

 private:
  static constexpr std::size_t kSize = std::size_t{1} << 14;
  struct Entry {
    LocalVertex p = 0, q = 0;
    std::uint32_t version_p = 0, version_q = 0;
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  static std::size_t slot(LocalVertex p, LocalVertex q) {
    const std::uint64_t key = std::uint64_t{std::min(p, q)} << 32 | std::max(p, q);
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15ULL >> 50);
  }
  static Entry entry(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    if (p > q) std::swap(p, q);
    return {p, q, mesh.version(p), mesh.version(q)};
  }

  std::vector<Entry> entries_;
};

}  // namespace mw
