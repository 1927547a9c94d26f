// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The large cells of the start mesh's octree, for the whole volume.
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

}  // namespace mw
