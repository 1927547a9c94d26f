// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Union-find whose roots are the smallest members, so that one ascending pass can number the sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace mw {

/// Sets over 0 .. count-1; 4 bytes a member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  std::uint32_t find(std::uint32_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

  /// Hands over the parents; every entry is a smaller member of the same set, or itself.
  std::vector<std::uint32_t> take_parents() { return std::move(parent_); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace mw
