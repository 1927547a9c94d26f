// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which interface triangle of a window carries which samples of the input's interfaces.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
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

/// Lists of samples by triangle: a hash table with linear probing over ranges of one pool.  While a
/// window is worked on, memory is allocated only when the table or the pool grows.
/// Nothing depends on the order of triangles in the table.  A list keeps the order in which it was
/// filled, hence is a function of the window's content.
/// Memory: some 32 bytes a sample, and 64 a triangle, or three times that while the table grows.
class CarriedSamples {
 public:
  /// A list that was taken away from its triangle.
  struct Taken {
    Label side = 0;
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    std::uint32_t capacity = 0;
  };

  [[nodiscard]] bool empty() const { return used_ == 0; }
  /// True when the triangle carries samples and `side` is the smaller label at it.
  [[nodiscard]] bool has(const TriangleKey& key, Label side) const {
    if (used_ == 0) return false;
    const Slot& slot = slots_[find(key)];
    return slot.list.size != 0 && slot.list.side == side;
  }
  /// The samples of the triangle; the span is valid until the next change.
  [[nodiscard]] std::span<const FaceSamples> of(const TriangleKey& key) const {
    if (used_ == 0) return {};
    const Taken& list = slots_[find(key)].list;
    return {pool_.data() + list.begin, list.size};
  }

  void add(const TriangleKey& key, Label side, FaceSamples sample);
  void erase(const TriangleKey& key) { static_cast<void>(take(key)); }

  /// Removes the triangle.  Its list may be given to another triangle, or is forgotten.
  /// REQUIRES: if give() is called with the list, it is called before the next add().
  [[nodiscard]] Taken take(const TriangleKey& key);
  /// Appends a list that was taken to that of a triangle.
  void give(const TriangleKey& key, const Taken& list);
  /// Keeps those samples of the triangle's list whose bit is set, in order; a triangle that keeps
  /// none is removed.  REQUIRES: `kept` has one bit for each sample of the list.
  void keep(const TriangleKey& key, const std::vector<bool>& kept);

 private:
  struct Slot {
    TriangleKey key{};
    Taken list;  ///< an empty list marks a free slot
  };

  [[nodiscard]] std::size_t home(const TriangleKey& key) const;
  /// Where the triangle is, or the free slot where it would be.  REQUIRES: slots_ not empty.
  [[nodiscard]] std::size_t find(const TriangleKey& key) const;
  [[nodiscard]] Slot& open(const TriangleKey& key, Label side);
  void make_room(Taken& list);
  void compact();
  void grow();
  void close_gap(std::size_t gap);

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  std::vector<FaceSamples> pool_;
  std::size_t live_ = 0;  ///< sum of the capacities of the lists in slots_
};

}  // namespace mw
