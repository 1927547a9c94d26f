// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The 1/1024-voxel lattice on which every vertex lies, and exact orientation on it.
#pragma once

#include <cstdint>

namespace mw {

__extension__ using Int128 = __int128;

inline constexpr std::int32_t kUnitsPerVoxel = 1024;
/// Six times the volume of a voxel, in cubic lattice units.
inline constexpr std::int64_t kVoxelVolume6 =
    std::int64_t{6} * kUnitsPerVoxel * kUnitsPerVoxel * kUnitsPerVoxel;

/// Largest extent, per axis, of a tetrahedron: 512 voxels.  Within it volume6 is exact in int64,
/// because |det| <= 6 * 2^57 and no partial sum exceeds 3 * 2^58.
inline constexpr std::int32_t kMaxTetExtent = 1 << 19;

/// Global vertex id: index of a voxel corner, x fastest (Sec 4.2).
using VertexId = std::uint64_t;

/// A position in lattice units (1/1024 voxel), relative to the volume's first corner.
struct Point {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  friend bool operator==(const Point&, const Point&) = default;
};

/// A position's coordinate along an axis: 0 for x, 1 for y, 2 for z.
[[nodiscard]] constexpr std::int32_t along(Point p, unsigned axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// The position with another coordinate along an axis.
[[nodiscard]] constexpr Point with_coordinate(Point p, unsigned axis, std::int32_t place) {
  (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = place;
  return p;
}

/// Six times the signed volume of tetrahedron (a, b, c, d) in cubic lattice units: the
/// determinant of (b - a, c - a, d - a); positive in the orientation that VTK asks for.
/// REQUIRES: extents within kMaxTetExtent.  ENSURES: exact.
[[nodiscard]] inline std::int64_t volume6(Point a, Point b, Point c, Point d) {
  const std::int64_t bx = std::int64_t{b.x} - a.x, by = std::int64_t{b.y} - a.y,
                     bz = std::int64_t{b.z} - a.z;
  const std::int64_t cx = std::int64_t{c.x} - a.x, cy = std::int64_t{c.y} - a.y,
                     cz = std::int64_t{c.z} - a.z;
  const std::int64_t dx = std::int64_t{d.x} - a.x, dy = std::int64_t{d.y} - a.y,
                     dz = std::int64_t{d.z} - a.z;
  return bx * (cy * dz - cz * dy) + by * (cz * dx - cx * dz) + bz * (cx * dy - cy * dx);
}

}  // namespace mw
