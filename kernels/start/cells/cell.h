// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells of the start mesh and the nodes on their surface.
#pragma once

#include <cstdint>

#include "kernels/core/index.h"

namespace mw {

/// A cube of 2^level voxels an axis, at a multiple of its size.
struct Cell {
  Index3 lo;
  int level = 0;

  [[nodiscard]] std::int64_t size() const { return std::int64_t{1} << level; }
};

/// Face of a cell: axis 0..2, on the low or high side.
struct CellFace {
  unsigned axis = 0;
  bool high = false;
};

/// A corner, middle of an edge, middle of a face, or centre of a cell: x + 3 y + 9 z, where x, y
/// and z count half edges.  So nodes of a cell ascend with their vertex ids.
using CellNode = unsigned;

inline constexpr CellNode kCellCentre = 13;

/// How far a node is along an axis: 0, 1 or 2 half edges.
[[nodiscard]] constexpr unsigned node_along(CellNode node, unsigned axis) {
  return (axis == 0 ? node : axis == 1 ? node / 3 : node / 9) % 3;
}

/// How much a node's number grows with one half edge along an axis.
[[nodiscard]] constexpr CellNode node_step(unsigned axis) {
  return axis == 0 ? 1U : axis == 1 ? 3U : 9U;
}

/// The voxel corner where the node is.  REQUIRES: the node of a single voxel is a corner of it.
[[nodiscard]] inline Index3 position_of(const Cell& cell, CellNode node) {
  const std::int64_t s = cell.size();
  return cell.lo + Index3{node_along(node, 0) * s / 2, node_along(node, 1) * s / 2,
                          node_along(node, 2) * s / 2};
}

[[nodiscard]] constexpr bool is_on(CellNode node, CellFace face) {
  return node_along(node, face.axis) == (face.high ? 2U : 0U);
}

/// A set of nodes, one bit for each.
using CellNodes = std::uint32_t;

[[nodiscard]] constexpr bool has_node(CellNodes nodes, CellNode node) {
  return (nodes >> node & 1U) != 0;
}

inline constexpr CellNodes kCellCorners =
    1U << 0 | 1U << 2 | 1U << 6 | 1U << 8 | 1U << 18 | 1U << 20 | 1U << 24 | 1U << 26;

/// True when the coordinate sum of the cell's lowest corner, in cells of its level, is odd.
[[nodiscard]] inline bool is_odd(const Cell& cell) {
  return (((cell.lo.x + cell.lo.y + cell.lo.z) >> cell.level) & 1) != 0;
}

}  // namespace mw
