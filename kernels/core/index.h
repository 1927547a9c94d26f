// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Integer positions and boxes in voxels, walks over them, and voxels of boxes from one array to
// another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mw {

/// A voxel, or a number of voxels along each axis; x is the fastest axis of every array.
struct Index3 {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;

  friend bool operator==(const Index3&, const Index3&) = default;
  friend Index3 operator+(Index3 a, Index3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Index3 operator-(Index3 a, Index3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

  [[nodiscard]] std::int64_t product() const { return x * y * z; }
};

/// The number along an axis (0 = x).
[[nodiscard]] constexpr std::int64_t along(Index3 v, unsigned axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// A step along an axis (0 = x).
[[nodiscard]] inline Index3 axis_vector(unsigned axis, std::int64_t length = 1) {
  return {axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

/// Returns the position of i in an x-fastest array of shape s.
[[nodiscard]] inline std::size_t raster(Index3 i, Index3 s) {
  return static_cast<std::size_t>((i.z * s.y + i.y) * s.x + i.x);
}

/// Returns the index of which raster() returns this place.
[[nodiscard]] inline Index3 index_at(std::size_t place, Index3 s) {
  const auto i = static_cast<std::int64_t>(place);
  return {i % s.x, i / s.x % s.y, i / s.x / s.y};
}

/// Half-open box of voxels: lo is inside, hi is not.
struct Box3 {
  Index3 lo;
  Index3 hi;

  friend bool operator==(const Box3&, const Box3&) = default;

  [[nodiscard]] Index3 shape() const { return hi - lo; }
  [[nodiscard]] std::int64_t voxels() const { return shape().product(); }
  [[nodiscard]] bool contains(Index3 v) const {
    return v.x >= lo.x && v.x < hi.x && v.y >= lo.y && v.y < hi.y && v.z >= lo.z && v.z < hi.z;
  }
  /// Position of voxel v in an x-fastest array over this box.  REQUIRES: contains(v).
  [[nodiscard]] std::int64_t offset(Index3 v) const {
    const Index3 s = shape();
    return ((v.z - lo.z) * s.y + (v.y - lo.y)) * s.x + (v.x - lo.x);
  }
};

/// True if no voxel is in the box.
[[nodiscard]] inline bool is_empty(const Box3& box) {
  return box.lo.x >= box.hi.x || box.lo.y >= box.hi.y || box.lo.z >= box.hi.z;
}

/// The smallest box that holds both; an empty box adds nothing.
[[nodiscard]] inline Box3 hull(const Box3& a, const Box3& b) {
  if (is_empty(a)) return b;
  if (is_empty(b)) return a;
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

/// The voxels of both boxes; nothing (lo not below hi) when they do not meet.
[[nodiscard]] inline Box3 intersection(const Box3& a, const Box3& b) {
  return {{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
          {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
}

/// The box and `by` voxels around it.
[[nodiscard]] inline Box3 grown(const Box3& box, std::int64_t by) {
  return {box.lo - Index3{by, by, by}, box.hi + Index3{by, by, by}};
}

/// Calls visit for every index of the box, x fastest.
template <typename Visit>
void for_each_index(const Box3& box, Visit visit) {
  for (Index3 i = box.lo; i.z < box.hi.z; ++i.z) {
    for (i.y = box.lo.y; i.y < box.hi.y; ++i.y) {
      for (i.x = box.lo.x; i.x < box.hi.x; ++i.x) visit(i);
    }
  }
}

/// Visits an array of the given shape.
template <typename Visit>
void for_each_index(Index3 shape, Visit visit) {
  for_each_index(Box3{{0, 0, 0}, shape}, visit);
}

/// The cells that a box meets; cell c is the box of shape `cell` that begins at c * cell.
/// REQUIRES: box.lo not negative, cell positive on every axis.
[[nodiscard]] inline Box3 cells_of(const Box3& box, Index3 cell) {
  const auto rounded_up = [](std::int64_t a, std::int64_t b) { return (a + b - 1) / b; };
  return {
      {box.lo.x / cell.x, box.lo.y / cell.y, box.lo.z / cell.z},
      {rounded_up(box.hi.x, cell.x), rounded_up(box.hi.y, cell.y), rounded_up(box.hi.z, cell.z)}};
}

/// The most voxels along an axis of a volume that is made, read or described.  It is twice what one
/// run can mesh (kMaxSampledVoxels in face_sample.h, where samples number voxels in 19 bits): a run
/// may take a part of the file (--crop), and says so before any work when its part is too long.
/// Within it coordinates fit int32 in units of 1/1024 voxel, and no product of extents overflows.
inline constexpr std::int64_t kMaxAxisVoxels = std::int64_t{1} << 20;

/// Copies the voxels of `part` from the array of one box to that of another, both x fastest.
/// REQUIRES: both boxes contain part, and the arrays have all voxels of their boxes.
template <typename Voxel>
void copy_box(const Box3& part, const Box3& from_box, std::span<const Voxel> from,
              const Box3& to_box, std::span<Voxel> to) {
  for (Index3 v = part.lo; v.z < part.hi.z; ++v.z) {
    for (v.y = part.lo.y; v.y < part.hi.y; ++v.y) {
      std::copy_n(from.data() + from_box.offset(v), part.shape().x, to.data() + to_box.offset(v));
    }
  }
}

}  // namespace mw
