// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The 1/1024-voxel lattice on which every vertex lies, exact orientation on it, and how voxels of
// thick slices are cut into layers, so that the lattice is nearly isotropic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "kernels/core/index.h"

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

/// A box in lattice units, closed.
struct LatticeBox {
  Point lo;
  Point hi;
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

/// The position that is `voxels` further on.  REQUIRES: it is in the range of coordinates.
[[nodiscard]] constexpr Point moved(Point p, Index3 voxels) {
  const auto units = [](std::int64_t v) { return static_cast<std::int32_t>(v * kUnitsPerVoxel); };
  return {p.x + units(voxels.x), p.y + units(voxels.y), p.z + units(voxels.z)};
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

/// Most layers of a voxel: more than any axis of a lattice may have, and few enough that their
/// number along an axis does not overflow.
inline constexpr std::int64_t kMaxLayers = std::int64_t{1} << 20;

/// Returns how many layers a voxel is cut into along each axis: its spacing over the smallest one,
/// rounded (halves up).  The layers' spacing is between 2/3 and 3/2 of the smallest one, and layers
/// fill the same solid as voxels, so topology and volumes do not change.
/// REQUIRES: spacing finite and positive.  ENSURES: from 1 to kMaxLayers; 1 along the finest axis.
[[nodiscard]] inline Index3 layers_of(const std::array<double, 3>& spacing) {
  const double smallest = *std::min_element(spacing.begin(), spacing.end());
  const auto along = [&](double s) {
    const double layers = std::floor(s / smallest + 0.5);
    return static_cast<std::int64_t>(std::min(layers, static_cast<double>(kMaxLayers)));
  };
  return {along(spacing[0]), along(spacing[1]), along(spacing[2])};
}

/// Returns the layers of the voxels of a volume that repeats itself along some axes (bit 0 = x).
/// The start mesh repeats itself after an even number of voxels.  So where another number would be
/// left along one of these axes, all layers are halved.
[[nodiscard]] inline Index3 layers_of(const std::array<double, 3>& spacing, Index3 shape,
                                      unsigned periodic) {
  const Index3 layers = layers_of(spacing);
  const bool is_odd = ((periodic & 1U) != 0 && shape.x * layers.x % 2 != 0) ||
                      ((periodic & 2U) != 0 && shape.y * layers.y % 2 != 0) ||
                      ((periodic & 4U) != 0 && shape.z * layers.z % 2 != 0);
  const std::int64_t parts = is_odd ? 2 : 1;
  return {parts * layers.x, parts * layers.y, parts * layers.z};
}

/// Voxels of the lattice along each axis.
[[nodiscard]] inline Index3 layered_shape(Index3 shape, Index3 layers) {
  return {shape.x * layers.x, shape.y * layers.y, shape.z * layers.z};
}

/// Spacing of the lattice.
[[nodiscard]] inline std::array<double, 3> layered_spacing(const std::array<double, 3>& spacing,
                                                           Index3 layers) {
  return {spacing[0] / static_cast<double>(layers.x), spacing[1] / static_cast<double>(layers.y),
          spacing[2] / static_cast<double>(layers.z)};
}

}  // namespace mw
