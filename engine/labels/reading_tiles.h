// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// In which boxes a whole volume is read.
#pragma once

#include "io/volume/label_volume.h"

namespace mw::engine {

/// Boxes of whole bricks (io::BrickVolume) that cover a volume, each read at once: as its chunks
/// are, if it has some, so that no chunk is unpacked twice; otherwise long rows.
class ReadingTiles {
 public:
  /// Voxels of a tile, unless a row of bricks or a slice's worth of one has more.
  static constexpr std::int64_t kMaxVoxels = 1 << 18;

  explicit ReadingTiles(const io::VolumeInfo& volume);

  /// How many along each axis.
  [[nodiscard]] Index3 count() const;
  /// The part of the volume that a tile is.  ENSURES: it begins at a brick, and ends at one or with
  /// the volume.
  [[nodiscard]] Box3 box(Index3 tile) const;

 private:
  Index3 shape_;
  Index3 edges_;
};

}  // namespace mw::engine
