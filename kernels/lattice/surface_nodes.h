// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which nodes the surface of a cell has, seen the same from all cells around.
#pragma once

#include "kernels/core/label_box.h"
#include "kernels/lattice/cell.h"
#include "kernels/lattice/cell_levels.h"

namespace mw {

/// Finds hanging nodes: middles of a cell's edges and faces that are vertices of the start mesh.
///
/// Beside a smaller cell, all middles that it touches are vertices.  Where labels meet, the leaves
/// are single voxels; eight of them that are partners, filling a cube of 2 voxels at an even place,
/// make one mixed cell of level 1.  Around mixed cells a middle is a vertex only if the labels need
/// it: that of an edge if one of the cubes there has two labels along the edge, that of a face if
/// one of the two cubes has two labels along it.  Voxels whose partners would lie outside the
/// volume stay single, and all middles that such a cube touches are vertices.
class SurfaceNodes {
 public:
  /// labels: those the levels are of.
  SurfaceNodes(const CellLevels& levels, const LabelBox& labels, Index3 volume)
      : levels_(levels), labels_(labels), volume_{{0, 0, 0}, volume} {}

  /// Corners and hanging nodes of a leaf or a mixed cell.
  /// REQUIRES: the cell and the leaves around it are where levels may be asked, with labels.
  [[nodiscard]] CellNodes of(const Cell& cell) const;

  /// Would some voxels of the cube of 2 voxels that the voxel belongs to lie outside the volume?
  [[nodiscard]] bool is_clipped(Index3 voxel) const {
    return !volume_.contains({voxel.x | 1, voxel.y | 1, voxel.z | 1});
  }

 private:
  [[nodiscard]] bool is_finer(Index3 voxel, int level) const;
  [[nodiscard]] bool layer_is_split(Index3 lowest, unsigned axis) const;
  [[nodiscard]] bool face_is_split(const Cell& cell, CellFace face) const;
  [[nodiscard]] bool edge_is_split(Index3 start, unsigned along, int level) const;

  const CellLevels& levels_;
  const LabelBox& labels_;
  Box3 volume_;
};

}  // namespace mw
