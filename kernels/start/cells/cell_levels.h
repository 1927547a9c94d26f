// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The graded octree of uniform cubes under the start mesh: the large cells of the whole volume, and
// which cell contains a voxel.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/core/label.h"
#include "kernels/size/size_field.h"

namespace mw {

/// Which cells of 8 and of 16 voxels an axis are allowed (CellLevels has the rule).  A block's
/// start mesh depends on such cells as far as 32 voxels away; looking them up here spares reading
/// labels from so far.  Memory: two bytes for 16^3 voxels.
class LevelMap {
 public:
  /// Voxels around a cube of 16 voxels that allowed_eighths() depends on.
  static constexpr std::int64_t kHalo = 6;
  static constexpr std::int64_t kCube = 16;

  LevelMap() = default;
  /// Holds all cubes of the volume, of which no cell is allowed yet.
  explicit LevelMap(Index3 volume);
  /// Holds only the cubes in `held`.  Cells of 16 voxels are known in those of them whose
  /// neighbours are all held, or outside the volume.
  LevelMap(Index3 volume, const Box3& held);

  [[nodiscard]] Index3 cubes() const { return cubes_; }
  [[nodiscard]] const Box3& held() const { return held_; }

  /// The eight cells of 8 voxels in cube `cube` that are allowed, as bits (x lowest).
  /// REQUIRES: labels cover the cube and kHalo around it.  Null sizes set no limits.
  [[nodiscard]] static std::uint8_t allowed_eighths(const LabelBox& labels, Index3 volume,
                                                    Index3 cube, const SizeField* sizes = nullptr);

  /// Thread safety: different cubes may be set at once.
  void set_eighths(Index3 cube, std::uint8_t eighths) { eighths_[row(cube)] = eighths; }

  /// Decides on the cells of 16 voxels.  REQUIRES: all eighths are set; is_uniform says whether a
  /// cube lies inside the volume and inside one label, and whether sizes allow it as one cell.
  template <typename IsUniform>
  void find_cubes(IsUniform is_uniform) {
    for_each_index(decided(), [&](Index3 c) {
      whole_[row(c)] = is_uniform(c) && eighths_around_allowed(c) ? 1 : 0;
    });
  }

  /// True if the cell of 2^level voxels around the voxel is allowed; false outside the volume.
  /// REQUIRES: level is 3 or 4, and cells of that level are known there.
  [[nodiscard]] bool is_allowed(Index3 voxel, int level) const;

  /// All that is known of a cube, as a number.  REQUIRES: the cube is held.
  [[nodiscard]] std::uint64_t bits_of(Index3 cube) const {
    return std::uint64_t{eighths_[row(cube)]} | std::uint64_t{whole_[row(cube)]} << 8U;
  }

 private:
  [[nodiscard]] std::size_t row(Index3 cube) const {
    return static_cast<std::size_t>(held_.offset(cube));
  }
  [[nodiscard]] Box3 decided() const;
  [[nodiscard]] bool eighths_around_allowed(Index3 cube) const;

  Index3 volume_;
  Index3 cubes_;
  Box3 held_;
  std::vector<std::uint8_t> eighths_;
  std::vector<std::uint8_t> whole_;
};

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
