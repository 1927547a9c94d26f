// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The tiles in which a mesh is compared with its volume.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/core/index.h"

namespace mw::engine {

/// Boxes of voxels that cover a volume, numbered x fastest.
class TileGrid {
 public:
  static constexpr std::int64_t kEdge = 64;
  static constexpr std::int64_t kMaxTiles = 1 << 14;

  /// Makes tiles of `edge` voxels of the lattice, and doubles the edge until they are few enough.
  TileGrid(Index3 shape, Index3 layers, std::int64_t edge = kEdge);

  [[nodiscard]] Index3 shape() const { return shape_; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(count_.product()); }
  [[nodiscard]] Box3 box(std::uint32_t tile) const;
  /// Returns the tile of the voxel at a point, in voxels from the first corner; points outside of
  /// the volume are taken to its nearest voxel.  REQUIRES: the point is finite.
  [[nodiscard]] std::uint32_t at(const std::array<double, 3>& point) const;
  /// Returns the positions in the grid of the tiles that meet a box of voxels.
  [[nodiscard]] Box3 meeting(const Box3& voxels) const;
  [[nodiscard]] std::uint32_t number(Index3 position) const {
    return static_cast<std::uint32_t>(Box3{{0, 0, 0}, count_}.offset(position));
  }

 private:
  Index3 shape_;
  Index3 edges_;
  Index3 count_;
};

}  // namespace mw::engine
