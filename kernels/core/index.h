// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Integer positions and boxes in voxels.
#pragma once

#include <algorithm>
#include <cstdint>

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

/// The voxels of both boxes; nothing (lo not below hi) when they do not meet.
[[nodiscard]] inline Box3 intersection(const Box3& a, const Box3& b) {
  return {{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
          {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
}

/// The box and `by` voxels around it.
[[nodiscard]] inline Box3 grown(const Box3& box, std::int64_t by) {
  return {box.lo - Index3{by, by, by}, box.hi + Index3{by, by, by}};
}

}  // namespace mw
