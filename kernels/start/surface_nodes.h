// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which nodes the surface of a cell has, seen the same from all cells around.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/core/label.h"
#include "kernels/start/cells/cell.h"
#include "kernels/start/cells/cell_levels.h"

namespace mw {

/// Finds hanging nodes: middles of a cell's edges and faces that are vertices of the start mesh.
///
/// Middles that touch a smaller cell are vertices.  Where labels meet, the leaves are single
/// voxels; eight of them that are partners, filling a cube of 2 voxels at an even place, make one
/// mixed cell of level 1.  Around mixed cells a middle is a vertex only if the labels need it: if
/// two voxels that touch it, neighbours along an axis that it is in the middle of, have different
/// labels.  Voxels whose partners would lie outside the volume stay single, and the middles that
/// they touch are vertices; so are those that touch a cube of 2 voxels too large for a SizeField.
class SurfaceNodes {
 public:
  /// REQUIRES: levels were found from these labels and sizes; null sizes set no limits.
  SurfaceNodes(const CellLevels& levels, const LabelBox& labels, Index3 volume,
               const SizeField* sizes = nullptr)
      : levels_(levels), labels_(labels), volume_{{0, 0, 0}, volume}, sizes_(sizes) {}

  /// Corners and hanging nodes of a leaf or a mixed cell.
  /// REQUIRES: levels and labels are known in the cell and in the leaves around it.
  [[nodiscard]] CellNodes of(const Cell& cell) const;

  /// True if the cube of 2 voxels that the voxel belongs to is partly outside the volume.
  [[nodiscard]] bool is_clipped(Index3 voxel) const {
    return !volume_.contains({voxel.x | 1, voxel.y | 1, voxel.z | 1});
  }

 private:
  /// Sets of the 4^3 voxels in and around a cube of 2 voxels, x fastest.
  struct Around {
    std::array<std::uint64_t, 3> steps{};  ///< the next voxel along the axis has another label
    std::uint64_t with_corners = 0;        ///< all corners of the voxel are vertices
  };

  [[nodiscard]] CellNodes beside_smaller(const Cell& cell) const;
  [[nodiscard]] CellNodes between_labels(const Cell& cell) const;
  [[nodiscard]] Around around(Index3 lo) const;
  [[nodiscard]] bool has_corners(Index3 voxel) const;

  const CellLevels& levels_;
  const LabelBox& labels_;
  Box3 volume_;
  const SizeField* sizes_;
};

}  // namespace mw
