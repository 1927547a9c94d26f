// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Hanging nodes from the levels of the cells around, or from labels around mixed cells.
#include "kernels/lattice/surface_nodes.h"

namespace mw {

bool SurfaceNodes::is_finer(Index3 voxel, int level) const {
  return volume_.contains(voxel) && levels_.level_at(voxel) < level;
}

/// The four voxels across an axis, from the lowest on, of a cube of 2 voxels: are they of different
/// labels, or single?
bool SurfaceNodes::layer_is_split(Index3 lowest, unsigned axis) const {
  if (!volume_.contains(lowest)) return false;
  if (is_clipped(lowest)) return true;
  const Index3 u = axis_vector(axis == 0 ? 1 : 0), v = axis_vector(axis == 2 ? 1 : 2);
  const Label label = labels_.at(lowest);
  return labels_.at(lowest + u) != label || labels_.at(lowest + v) != label ||
         labels_.at(lowest + u + v) != label;
}

bool SurfaceNodes::face_is_split(const Cell& cell, CellFace face) const {
  const Index3 within = cell.lo + axis_vector(face.axis, face.high ? cell.size() - 1 : 0);
  const Index3 beyond = within + axis_vector(face.axis, face.high ? 1 : -1);
  if (cell.level > 1) return is_finer(beyond, cell.level);
  return layer_is_split(within, face.axis) || layer_is_split(beyond, face.axis);
}

bool SurfaceNodes::edge_is_split(Index3 start, unsigned along, int level) const {
  const unsigned first = along == 0 ? 1 : 0, second = along == 2 ? 1 : 2;
  for (unsigned i = 0; i < 4; ++i) {
    const Index3 voxel = start - axis_vector(first, i & 1U) - axis_vector(second, i >> 1);
    if (level > 1) {
      if (is_finer(voxel, level)) return true;
    } else if (volume_.contains(voxel)) {
      if (is_clipped(voxel)) return true;
      if (labels_.at(voxel) != labels_.at(voxel + axis_vector(along))) return true;
    }
  }
  return false;
}

CellNodes SurfaceNodes::of(const Cell& cell) const {
  CellNodes nodes = kCellCorners;
  if (cell.level == 0) return nodes;
  for (CellNode node = 0; node <= 26; ++node) {
    unsigned middles = 0, along = 0, across = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const bool middle = node_along(node, axis) == 1;
      middles += middle ? 1 : 0;
      (middle ? along : across) = axis;
    }
    const bool high = node_along(node, across) == 2;
    const bool split = (middles == 1 && edge_is_split(place_of(cell, node - node_step(along)),
                                                      along, cell.level)) ||
                       (middles == 2 && face_is_split(cell, {across, high}));
    if (split) nodes |= 1U << node;
  }
  return nodes;
}

}  // namespace mw
