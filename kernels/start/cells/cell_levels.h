// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The graded octree of uniform cubes under the start mesh: which cell contains a voxel.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/core/label.h"
#include "kernels/size/size_field.h"
#include "kernels/start/cells/level_map.h"

namespace mw {

/// Leaves of an octree over the volume: cubes of 2^k voxels, aligned to multiples of their size,
/// inside the volume and inside one label, 2:1 balanced over faces, edges and corners.
///
/// A cell of 2^k voxels is allowed when its labels are uniform, it is as small as a SizeField asks,
/// and every cell of 2^(k-1) voxels in or next to it is allowed; single voxels always are.  The
/// leaf at a voxel is the largest allowed cell around it.  So balance holds by construction, and a
/// leaf depends on labels nearer than its own size: every block sees the same leaves.
class CellLevels {
 public:
  /// Leaves have at most 2^max_level voxels an axis; all levels are found from the labels.
  /// level_at() may be called for the voxels of `asked`.  Null sizes set no limits.
  /// REQUIRES: asked is at least 2^(max_level+1) - 2 voxels inside labels.box, or nearer to its
  ///           sides where they are those of the volume.
  CellLevels(const LabelBox& labels, Index3 volume, const Box3& asked, int max_level,
             const SizeField* sizes = nullptr);

  /// Takes levels above 2 from `large`, so that labels of 6 voxels around `asked` are enough.
  /// REQUIRES: max_level <= 4; large was made for this volume and these sizes.
  CellLevels(const LabelBox& labels, Index3 volume, const Box3& asked, int max_level,
             const LevelMap& large, const SizeField* sizes = nullptr);

  /// Level k of the leaf that contains the voxel.  REQUIRES: voxel in asked and the volume.
  [[nodiscard]] int level_at(Index3 voxel) const {
    return leaves_[static_cast<std::size_t>(
        pairs_.offset({voxel.x >> 1, voxel.y >> 1, voxel.z >> 1}))];
  }

 private:
  /// Cells of one level that meet both labels.box and the volume.
  struct Level {
    Box3 cells;
    std::vector<std::uint8_t> allowed;
  };

  void find_levels(int highest);
  void find_leaves(const Box3& asked);
  [[nodiscard]] std::uint8_t small_level_at(Index3 voxel) const;
  [[nodiscard]] Level cells_of(int level) const;
  [[nodiscard]] bool is_uniform(Index3 cell, int level) const;
  [[nodiscard]] bool is_small(Index3 cell, int level) const;
  [[nodiscard]] bool finer_allowed(Index3 cell, int level) const;

  const LabelBox& labels_;
  Box3 known_;  ///< part of labels.box that is inside the volume
  Index3 volume_;
  const SizeField* sizes_;
  std::vector<Level> levels_;         ///< levels_[k - 1] holds level k
  Box3 pairs_;                        ///< cells of 2 voxels that meet `asked`
  std::vector<std::uint8_t> leaves_;  ///< level of the leaf at each of these
};

}  // namespace mw
