// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Hanging nodes from the levels of the cells around, or from labels around mixed cells.
#include "kernels/start/surface_nodes.h"

#include "kernels/core/index.h"

namespace mw {
namespace {

/// The corners, and those middles of edges and faces for which is_vertex(node) holds.
template <typename IsVertex>
CellNodes with_middles(IsVertex is_vertex) {
  CellNodes nodes = kCellCorners;
  for (CellNode node = 0; node <= 26; ++node) {
    if (has_node(kCellCorners, node) || node == kCellCentre) continue;
    if (is_vertex(node)) nodes |= 1U << node;
  }
  return nodes;
}

constexpr std::array<std::size_t, 3> kStrides{1, 4, 16};

}  // namespace

CellNodes SurfaceNodes::of(const Cell& cell) const {
  if (cell.level == 0) return kCellCorners;
  return cell.level > 1 ? beside_smaller(cell) : between_labels(cell);
}

CellNodes SurfaceNodes::beside_smaller(const Cell& cell) const {
  return with_middles([&](CellNode node) {
    const Index3 at = position_of(cell, node);
    for (std::int64_t i = 0; i < 8; ++i) {
      const Index3 voxel = at - Index3{i & 1, i >> 1 & 1, i >> 2};
      if (volume_.contains(voxel) && levels_.level_at(voxel) < cell.level) return true;
    }
    return false;
  });
}

CellNodes SurfaceNodes::between_labels(const Cell& cell) const {
  const Around near = around(cell.lo);
  return with_middles([&near](CellNode node) {
    std::size_t lowest = 0;  // the lowest of the eight voxels that touch the node
    for (unsigned axis = 0; axis < 3; ++axis) lowest += node_along(node, axis) * kStrides[axis];
    for (unsigned i = 0; i < 8; ++i) {
      const std::size_t voxel = lowest + (i & 1U) + (i >> 1 & 1U) * 4 + (i >> 2) * 16;
      if (near.has_corners[voxel]) return true;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const bool lower = (i >> axis & 1U) == 0;
        if (!lower || node_along(node, axis) != 1) continue;
        if (near.labels[voxel] != near.labels[voxel + kStrides[axis]]) return true;
      }
    }
    return false;
  });
}

bool SurfaceNodes::has_corners(Index3 voxel) const {
  if (is_clipped(voxel)) return true;
  return sizes_ != nullptr && !sizes_->allows_cell({voxel.x & ~1LL, voxel.y & ~1LL, voxel.z & ~1LL},
                                                   1, labels_.at(voxel));
}

SurfaceNodes::Around SurfaceNodes::around(Index3 lo) const {
  Around out{};
  const Box3 box = grown({lo, lo + Index3{2, 2, 2}}, 1);
  const bool may = sizes_ != nullptr || !volume_.contains(box.hi);
  std::size_t i = 0;
  for_each_index(box, [&](Index3 voxel) {
    out.labels[i] = labels_.at(voxel);
    out.has_corners[i] = may && volume_.contains(voxel) && has_corners(voxel);
    ++i;
  });
  return out;
}

}  // namespace mw
