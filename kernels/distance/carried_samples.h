// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which interface triangle of a window carries which samples of the input's interfaces.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/core/face_sample.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// A triangle by its local vertices, ascending.
using TriangleKey = std::array<LocalVertex, 3>;

[[nodiscard]] inline TriangleKey triangle_key(LocalVertex a, LocalVertex b, LocalVertex c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

/// Lists of samples by triangle: a hash table with linear probing over chains in one pool, so that
/// nothing is allocated while a window is worked on, but when the pool grows.
/// Nothing depends on the order of triangles in the table.  Sums over a list follow its order,
/// which is that of the calls of add(), hence a function of the window's content.
class CarriedSamples {
 public:
  [[nodiscard]] bool empty() const { return used_ == 0; }
  /// True when the triangle carries samples and `side` is the smaller label at it.
  [[nodiscard]] bool has(const TriangleKey& key, Label side) const {
    if (used_ == 0) return false;
    const Slot& slot = slots_[find(key)];
    return slot.head != kNone && slot.side == side;
  }

  void add(const TriangleKey& key, Label side, FaceSamples sample);
  void erase(const TriangleKey& key);

  /// Calls visit(sample) for each sample of the triangle, until it returns false.
  /// ENSURES: false when visit did.
  template <typename Visit>
  bool each(const TriangleKey& key, Visit visit) const {
    if (used_ == 0) return true;
    for (std::uint32_t n = slots_[find(key)].head; n != kNone; n = pool_[n].next) {
      if (!visit(pool_[n].sample)) return false;
    }
    return true;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  struct Slot {
    TriangleKey key{};
    Label side = 0;
    std::uint32_t head = kNone;  ///< kNone: the slot is free
  };
  struct Node {
    FaceSamples sample = 0;
    std::uint32_t next = kNone;
  };

  [[nodiscard]] std::size_t home(const TriangleKey& key) const;
  /// Where the triangle is, or the free slot where it would be.  REQUIRES: slots_ not empty.
  [[nodiscard]] std::size_t find(const TriangleKey& key) const;
  void grow();
  void close_gap(std::size_t gap);

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  std::vector<Node> pool_;
  std::uint32_t free_nodes_ = kNone;
};

}  // namespace mw
