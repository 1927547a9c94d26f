// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Visits the cells that a slab of voxels touches.
#pragma once

#include "kernels/synth/cell_grid.h"

namespace mw {

/// Calls visit(cell, box) for each cell that has voxels in slab; box are these voxels.
template <class Visit>
void for_each_cell(const CellGrid& grid, const Box3& slab, Visit visit) {
  const auto cell_of = [&](Index3 v) {
    return Index3{grid.cell_of(v.x), grid.cell_of(v.y), grid.cell_of(v.z)};
  };
  const Index3 first = cell_of(slab.lo);
  const Index3 last = cell_of(slab.hi - Index3{1, 1, 1});
  const auto begin = [&](std::int64_t cell, std::int64_t lo) {
    return std::max(lo, grid.first_voxel(cell));
  };
  const auto end = [&](std::int64_t cell, std::int64_t hi) {
    return std::min(hi, grid.first_voxel(cell + 1));
  };
  for (std::int64_t z = first.z; z <= last.z; ++z) {
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        visit(Index3{x, y, z}, Box3{{begin(x, slab.lo.x), begin(y, slab.lo.y), begin(z, slab.lo.z)},
                                    {end(x, slab.hi.x), end(y, slab.hi.y), end(z, slab.hi.z)}});
      }
    }
  }
}

/// Distance in units from a voxel's centre to a coordinate, squared.
[[nodiscard]] inline std::int64_t squared_distance(std::int64_t voxel, std::int64_t coordinate) {
  const std::int64_t d = voxel * kSynthUnits + kSynthUnits / 2 - coordinate;
  return d * d;
}

}  // namespace mw
