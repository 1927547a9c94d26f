// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks, windows and the marching order (Sec 4.1): who covers what, and who comes before whom.
#pragma once

#include <array>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw::engine {

/// Cuts a volume into cubic blocks and covers it by windows of 2 x 2 x 2 blocks, one block apart.
///
/// Blocks at the far sides may be short.  An axis of a single block has a single window.  The order
/// of windows is x fastest, then y, then z.
///
/// A volume that repeats itself along an axis may be covered from another block on: blocks from
/// `first` to the last one, then those before `first`, which are in places of the next copy of the
/// volume.  Windows then lie across the end of the volume, and none across the plane where the grid
/// begins.
class WindowGrid {
 public:
  /// REQUIRES: every axis of volume >= 1; window even and >= 2; first is a block.
  WindowGrid(Index3 volume, int window, Index3 first = {0, 0, 0});

  [[nodiscard]] Index3 volume() const { return volume_; }
  [[nodiscard]] Index3 first() const { return first_; }
  [[nodiscard]] std::int64_t block_edge() const { return block_edge_; }
  [[nodiscard]] Index3 blocks() const { return blocks_; }
  [[nodiscard]] Index3 windows() const { return windows_; }

  /// The block's index where the grid begins at the volume's corner, and back.
  [[nodiscard]] Index3 in_volume(Index3 block) const;
  [[nodiscard]] Index3 in_grid(Index3 block) const;
  /// How many voxels a block's places are beyond those in the volume.
  [[nodiscard]] Index3 beyond(Index3 block) const;

  /// Voxels of a block, cut off at the end of the volume.
  [[nodiscard]] Box3 block_box(Index3 block) const;
  /// Voxels of the window's blocks.
  [[nodiscard]] Box3 window_box(Index3 window) const;

  /// The blocks of a window, ascending in raster order: 8, fewer along axes of a single block.
  [[nodiscard]] std::vector<Index3> blocks_of(Index3 window) const;

  /// Returns the block of a window that owns a tet: the block that holds its barycentre, or the
  /// nearest block of the window if that block lies outside it.
  /// `sum` is the exact sum of the positions of the tet's four vertices.
  [[nodiscard]] Index3 owner(Index3 window, const std::array<std::int64_t, 3>& sum) const;
  /// Returns the sums from which on owner() is the window's upper block, by axis; along an axis of
  /// one block, a number above all sums.
  [[nodiscard]] std::array<std::int64_t, 3> least_sums_above(Index3 window) const;

  /// Returns the windows that must be finished before this one: the transitive reduction of its 13
  /// neighbours earlier in march order, which is (-1,0,0), (+1,-1,0), (+1,+1,-1), clamped where a
  /// +1 leaves the grid.
  [[nodiscard]] std::vector<Index3> predecessors(Index3 window) const;

 private:
  Index3 volume_;
  std::int64_t block_edge_;
  Index3 first_;
  Index3 blocks_;
  Index3 windows_;
};

}  // namespace mw::engine
