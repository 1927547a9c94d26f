// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Hanging nodes from the levels of the cells around, or from labels around mixed cells.
#include "kernels/start/surface_nodes.h"

#include <cstring>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"
#include "kernels/core/lanes.h"

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

/// Sets of the 4^3 voxels in and around a mixed cell that matter to a node.
struct NodeVoxels {
  std::uint64_t touching = 0;            ///< the eight that touch it
  std::array<std::uint64_t, 3> lower{};  ///< by axis: those below it, where it is a middle
};

constexpr std::array<NodeVoxels, 27> voxels_by_node() {
  std::array<NodeVoxels, 27> out{};
  for (CellNode node = 0; node < out.size(); ++node) {
    for (unsigned i = 0; i < 8; ++i) {
      unsigned voxel = 0;
      for (unsigned axis = 0; axis < 3; ++axis) {
        voxel += (node_along(node, axis) + (i >> axis & 1U)) << 2 * axis;
      }
      const std::uint64_t bit = std::uint64_t{1} << voxel;
      out[node].touching |= bit;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const bool is_below = (i >> axis & 1U) == 0 && node_along(node, axis) == 1;
        out[node].lower[axis] |= is_below ? bit : 0;
      }
    }
  }
  return out;
}
constexpr std::array<NodeVoxels, 27> kVoxelsAt = voxels_by_node();

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
    const NodeVoxels& voxels = kVoxelsAt[node];
    std::uint64_t found = near.with_corners & voxels.touching;
    for (std::size_t axis = 0; axis < 3; ++axis) found |= near.steps[axis] & voxels.lower[axis];
    return found != 0;
  });
}

bool SurfaceNodes::has_corners(Index3 voxel) const {
  if (is_clipped(voxel)) return true;
  return sizes_ != nullptr && !sizes_->allows_cell({voxel.x & ~1LL, voxel.y & ~1LL, voxel.z & ~1LL},
                                                   1, labels_.at(voxel));
}

SurfaceNodes::Around SurfaceNodes::around(Index3 lo) const {
  Around out;
  const Box3 box = grown({lo, lo + Index3{2, 2, 2}}, 1);
  MW_ASSERT(intersection(box, labels_.box) == box);
  std::array<LaneInts, 16> rows;  // along x
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Index3 first{0, static_cast<std::int64_t>(row % 4), static_cast<std::int64_t>(row / 4)};
    std::memcpy(&rows[row], labels_.labels.data() + labels_.box.offset(box.lo + first),
                sizeof rows[row]);
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const LaneInts here = rows[row];
    const auto compare = [&](std::size_t axis, const LaneInts& next) {
      out.steps[axis] |= std::uint64_t{lane_bits(here != next)} << 4 * row;
    };
    compare(0, __builtin_shufflevector(here, here, 1, 2, 3, 3));
    if (row % 4 != 3) compare(1, rows[row + 1]);
    if (row / 4 != 3) compare(2, rows[row + 4]);
  }
  if (sizes_ == nullptr && volume_.contains(box.hi)) return out;
  unsigned i = 0;
  for_each_index(box, [&](Index3 voxel) {
    const bool is_cornered = volume_.contains(voxel) && has_corners(voxel);
    out.with_corners |= std::uint64_t{is_cornered} << i++;
  });
  return out;
}

}  // namespace mw
