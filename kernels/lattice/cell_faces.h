// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The triangles of a leaf's faces, the same from both sides.
#pragma once

#include <array>
#include <vector>

#include "kernels/lattice/cell_levels.h"

namespace mw {

/// A leaf of the octree.
struct Cell {
  Index3 lo;
  int level = 0;

  [[nodiscard]] std::int64_t size() const { return std::int64_t{1} << level; }
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Face of a cell: axis 0..2, on the low or high side.
struct CellFace {
  unsigned axis = 0;
  bool high = false;

  friend bool operator==(const CellFace&, const CellFace&) = default;
};

/// A triangle by voxel corners.
using CornerTriangle = std::array<Index3, 3>;

[[nodiscard]] inline Index3 axis_vector(unsigned axis, std::int64_t length = 1) {
  return {axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

/// Corner i of a cell; bit 0 of i is the upper side along x, and so on.
[[nodiscard]] inline Index3 cell_corner(const Cell& cell, unsigned i) {
  const std::int64_t s = cell.size();
  return cell.lo + Index3{(i & 1U) * s, (i >> 1 & 1U) * s, (i >> 2 & 1U) * s};
}

/// True when the corner's coordinate sum, in cells of the level, is odd.
/// REQUIRES: corner at multiples of 2^level.
[[nodiscard]] inline bool is_odd(Index3 corner, int level) {
  return (((corner.x + corner.y + corner.z) >> level) & 1) != 0;
}

/// Finds hanging nodes and triangulates faces.
class CellFaces {
 public:
  CellFaces(const CellLevels& levels, Index3 volume) : levels_(levels), volume_(volume) {}

  /// True when a smaller leaf touches the cell's face or one of its edges.
  [[nodiscard]] bool has_hanging_nodes(const Cell& cell) const;

  /// Triangles of the face; their turning is not defined.
  void triangles(const Cell& cell, CellFace face, std::vector<CornerTriangle>& out) const;

 private:
  [[nodiscard]] bool is_finer(Index3 voxel, int level) const;
  [[nodiscard]] bool face_is_split(const Cell& cell, CellFace face) const;
  [[nodiscard]] bool edge_is_split(const Cell& cell, unsigned along, Index3 start) const;

  const CellLevels& levels_;
  Index3 volume_;
};

}  // namespace mw
