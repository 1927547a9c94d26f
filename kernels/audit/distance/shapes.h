// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Points, boxes and triangles in voxel units, and how far a point is from them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace mw::audit {

/// A point in voxels: (p - origin) / spacing along each axis.
using VoxelPoint = std::array<double, 3>;

/// A triangle by its corners, in any order.
using VoxelTriangle = std::array<VoxelPoint, 3>;

/// All points between two corners; flat for a voxel face.
struct Extent {
  VoxelPoint lo{};
  VoxelPoint hi{};
};

[[nodiscard]] inline double squared_distance(const VoxelPoint& p, const Extent& box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double away = std::max(std::max(box.lo[k] - p[k], p[k] - box.hi[k]), 0.0);
    sum += away * away;
  }
  return sum;
}

/// Squared distance to the nearest point of a triangle, which may be degenerate.  Up to rounding it
/// is always the distance to some point of the triangle, so none ever seems nearer than it is.
[[nodiscard]] double squared_distance(const VoxelPoint& p, const VoxelTriangle& t);

[[nodiscard]] inline Extent extent_of(const VoxelTriangle& t) {
  Extent box{t[0], t[0]};
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = std::min({t[0][k], t[1][k], t[2][k]});
    box.hi[k] = std::max({t[0][k], t[1][k], t[2][k]});
  }
  return box;
}

/// Position of a cell along a space-filling curve (Morton 1966).  REQUIRES: coordinates < 2^20.
[[nodiscard]] std::uint64_t curve_position(const std::array<std::uint32_t, 3>& cell);

}  // namespace mw::audit
