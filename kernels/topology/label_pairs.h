// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels share a triangle at a vertex or at an edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mw {

/// A symmetric relation on at most 64 labels, given by their places in some list.
class LabelPairs {
 public:
  using Mask = std::uint64_t;

  void reset(std::size_t labels) { with_.assign(labels, 0); }
  /// Nothing happens for a == b.
  void add(std::size_t a, std::size_t b) {
    if (a == b) return;
    with_[a] |= Mask{1} << b;
    with_[b] |= Mask{1} << a;
  }
  /// All labels that are paired with a, by place.
  [[nodiscard]] Mask with(std::size_t a) const { return with_[a]; }

 private:
  std::vector<Mask> with_;
};

}  // namespace mw
