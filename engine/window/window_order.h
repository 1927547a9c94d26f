// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which window comes before which (Sec 4.1), and a second order that is far wider.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/settings/settings.h"
#include "engine/window/window_grid.h"

namespace mw::engine {

/// An order of the windows of a grid: a sequence, which is the reference, and the edges that any
/// other execution must respect.  Windows that share a block are joined by a path of edges, always
/// in the direction of the sequence, so every execution that respects the edges gives the
/// sequence's result (promise P5).  The order is a pure function of the grid.
///
/// kRaster: x fastest, then y, then z; the edges are the three of WindowGrid::predecessors().  The
/// longest path has about X + 2Y + 4Z windows.
///
/// kColour: the parities of (z,y,x) are a colour, and colours come in the order of their Gray code,
/// in which each differs from the one before in one axis.  So along z even windows come before odd
/// ones; along y, in the layers of odd z, odd ones before even ones; along x, odd ones before even
/// ones where y + z is odd.  No two neighbours have the same colour, and colours ascend along every
/// path, so no path is longer than 8 windows whatever the volume, and an eighth of all windows may
/// run at once.  What an edit changes reaches one window further along an axis each time that the
/// axis's parity changes: four times along x, twice along y, once along z, which is half of the
/// windows that plain counting would reach.  The sequence does not go colour by colour over the
/// whole volume: along z it visits 0, 2, 1, 4, 3, 6, 5, ..., along the others this or 1, 0, 3, 2,
/// 5, 4, ...  It obeys the same edges and keeps three layers of blocks in use (two in kRaster).
class WindowOrder {
 public:
  WindowOrder(const WindowGrid& grid, Order order) : grid_(grid), order_(order) {}

  [[nodiscard]] const WindowGrid& grid() const { return grid_; }
  [[nodiscard]] std::uint64_t size() const {
    return static_cast<std::uint64_t>(grid_.windows().product());
  }

  /// Return the sequence, and its inverse.  REQUIRES: rank < size(); window in the grid.
  [[nodiscard]] Index3 window(std::uint64_t rank) const;
  [[nodiscard]] std::uint64_t rank(Index3 window) const;

  /// Return the ends of edges to and from a window: at most 2 in kColour, 3 and 7 in kRaster.
  [[nodiscard]] std::vector<Index3> predecessors(Index3 window) const;
  [[nodiscard]] std::vector<Index3> successors(Index3 window) const;

  /// Return the neighbours (windows that share a block) that come before and after this one.
  [[nodiscard]] std::vector<Index3> earlier_neighbours(Index3 window) const;
  [[nodiscard]] std::vector<Index3> later_neighbours(Index3 window) const;

  /// Returns the length of the longest path that ends at the window: the earliest step at which it
  /// runs if each visit takes a step.  The longest path from it has steps() - 1 - step() edges.
  [[nodiscard]] std::int64_t step(Index3 window) const;
  /// Returns the number of windows of the longest path.
  [[nodiscard]] std::int64_t steps() const;

 private:
  [[nodiscard]] std::vector<Index3> neighbours(Index3 window) const;

  WindowGrid grid_;
  Order order_;
};

}  // namespace mw::engine
