// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point where the scores of two labels are equal, for nodes of curved interfaces.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/labels/label_table.h"
#include "io/volume/number_volume.h"
#include "kernels/source/crossing.h"

namespace mw::engine {

/// Finds where interfaces lie in a volume whose labels come from scores.  It keeps tiles that it
/// has read: 8 MiB.  Thread safety: none.
class ScoreSurface {
 public:
  /// REQUIRES: the volume has scores of its own shape, and outlives this.
  explicit ScoreSurface(const io::DenseVolume& volume);

  /// Returns a point near a place of the world where the scores of two labels are equal; nothing
  /// when there is none within a voxel and a half, when the voxel there has a third label, and for
  /// labels without scores.  ERRORS: those of reading the volume and its scores.
  [[nodiscard]] std::optional<io::Vector3> nearest(const io::Vector3& place, RawLabel one,
                                                   RawLabel other);

 private:
  class Difference;
  /// A box of voxels with their scores of one label, or their labels.
  struct Tile {
    Box3 box;
    std::vector<double> numbers;
  };
  /// The label of the scores, or kLabelsThemselves; then the number of the tile.
  using TileId = std::pair<RawLabel, std::int64_t>;
  static constexpr RawLabel kLabelsThemselves = ~RawLabel{0};

  [[nodiscard]] const Tile& tile_at(RawLabel label, Index3 voxel);
  [[nodiscard]] CubicValues scores_from(RawLabel label, Index3 first);
  [[nodiscard]] bool is_of(const Vec3& point, RawLabel one, RawLabel other);

  const io::LabelVolume& volume_;
  const io::LabelScores& scores_;
  std::map<TileId, Tile> tiles_;
  std::deque<TileId> order_;  ///< of the tiles, the oldest first
};

}  // namespace mw::engine
