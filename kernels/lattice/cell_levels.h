// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The graded octree of uniform cubes under the start mesh: which cell contains a voxel.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/core/label_box.h"
#include "kernels/lattice/level_map.h"

namespace mw {

/// Leaves of an octree over the volume: cubes of 2^k voxels, aligned to multiples of their size,
/// inside the volume and inside one label, 2:1 balanced over faces, edges and corners.
///
/// A cell of 2^k voxels is allowed when its labels are uniform and every cell of 2^(k-1) voxels in
/// or next to it is allowed; single voxels always are.  The leaf at a voxel is the largest allowed
/// cell around it.  So balance holds by construction, and a leaf depends on labels nearer than its
/// own size: every block sees the same leaves.
class CellLevels {
 public:
  /// Leaves have at most 2^max_level voxels an axis; all levels are found from the labels.
  /// ENSURES: level_at() is exact for voxels at least 2^(max_level+1) - 2 inside labels.box, or
  ///          nearer to its sides where they are those of the volume; for max_level 0 everywhere.
  CellLevels(const LabelBox& labels, Index3 volume, int max_level);

  /// The same, with levels above 2 taken from `large`, so that 6 voxels are enough.
  /// REQUIRES: max_level <= 4; large is of this volume and outlives the object.
  CellLevels(const LabelBox& labels, Index3 volume, int max_level, const LevelMap& large);

  /// Level k of the leaf that contains the voxel.  REQUIRES: voxel in labels.box and the volume.
  [[nodiscard]] int level_at(Index3 voxel) const;

 private:
  /// Cells of one level that meet both labels.box and the volume.
  struct Level {
    Box3 cells;
    std::vector<std::uint8_t> allowed;
  };

  void find_levels(int highest);
  [[nodiscard]] Level cells_of(int level) const;
  [[nodiscard]] bool is_uniform(Index3 cell, int level) const;
  [[nodiscard]] bool finer_allowed(Index3 cell, int level) const;

  const LabelBox& labels_;
  Box3 known_;  ///< part of labels.box that is inside the volume
  Index3 volume_;
  std::vector<Level> levels_;  ///< levels_[k - 1] holds level k
  const LevelMap* large_ = nullptr;
  int max_level_ = 0;
};

}  // namespace mw
