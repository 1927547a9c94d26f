// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The grid of cubic cells in which the synthetic objects sit.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernels/core/index.h"
#include "kernels/core/label.h"
#include "kernels/synth/counter_hash.h"

namespace mw {

/// Fixed point: voxel i covers i * kSynthUnits .. (i + 1) * kSynthUnits.
inline constexpr std::int64_t kSynthUnits = 64;

/// Cells of one size from the first corner on.
struct CellGrid {
  std::int64_t edge = kSynthUnits;  ///< of a cell, in units
  Index3 count;                     ///< cells along each axis
  std::uint64_t labels = 1;

  [[nodiscard]] std::int64_t cell_of(std::int64_t voxel) const {
    return (voxel * kSynthUnits + kSynthUnits / 2) / edge;
  }
  /// First voxel whose centre is in the cell or behind it.
  [[nodiscard]] std::int64_t first_voxel(std::int64_t cell) const {
    return (cell * edge - kSynthUnits / 2 + kSynthUnits - 1) / kSynthUnits;
  }
  [[nodiscard]] bool contains(Index3 c) const { return Box3{{}, count}.contains(c); }

  /// 0 .. N-1, each for as many cells as any other, give or take one.
  [[nodiscard]] std::uint64_t rank(Index3 cell) const {
    const auto index = static_cast<std::uint64_t>(Box3{{}, count}.offset(cell));
    const auto cells = static_cast<std::uint64_t>(count.product());
    if (cells <= labels) return index;
    return static_cast<std::uint64_t>(Wide{index} * labels / cells);
  }
  /// Whether the cell is the first of its rank: where there is one object a label, it is there.
  [[nodiscard]] bool is_first(Index3 cell) const {
    return (cell.x == 0 && cell.y == 0 && cell.z == 0) || rank(cell) != rank(before(cell));
  }

 private:
  [[nodiscard]] Index3 before(Index3 cell) const {
    if (cell.x > 0) return {cell.x - 1, cell.y, cell.z};
    if (cell.y > 0) return {count.x - 1, cell.y - 1, cell.z};
    return {count.x - 1, count.y - 1, cell.z - 1};
  }
};

enum class CellFit {
  kCover,   ///< the last cells may stick out: every voxel is in a cell
  kInside,  ///< only whole cells
};

/// The largest cells of which there are at least `labels`; cells of one voxel when there are not.
/// With flat, cells span all of z.
[[nodiscard]] CellGrid make_cell_grid(Index3 shape, std::uint64_t labels, CellFit fit, bool flat);

}  // namespace mw
