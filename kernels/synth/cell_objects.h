// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Random numbers without state, a number for each key; synthetic objects, and the grid of cubic
// cells in which they sit.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernels/core/index.h"
#include "kernels/core/label.h"
#include "kernels/core/mix_bits.h"
#include "kernels/synth/synth.h"

namespace mw {

__extension__ using Wide = unsigned __int128;

/// A number for a place (each coordinate below 2^21), the same in every run.
[[nodiscard]] constexpr std::uint64_t hash_position(std::uint64_t seed, Index3 position) {
  const auto part = [](std::int64_t i) { return static_cast<std::uint64_t>(i) & 0x1fffffU; };
  const std::uint64_t key = part(position.x) | part(position.y) << 21 | part(position.z) << 42;
  return mix_bits(key ^ mix_bits(seed));
}

/// An integer in lo .. hi-1 from a hash; the bias is below (hi - lo) / 2^32.
[[nodiscard]] constexpr std::int64_t pick(std::uint64_t hash, std::int64_t lo, std::int64_t hi) {
  const auto range = static_cast<std::uint64_t>(hi - lo);
  return lo + static_cast<std::int64_t>(((hash >> 32) * range) >> 32);
}

/// Units in a voxel: voxel i covers i * kSynthUnits .. (i + 1) * kSynthUnits.
inline constexpr std::int64_t kSynthUnits = 64;

/// Cells of one size from the first corner on.
struct CellGrid {
  std::int64_t edge = kSynthUnits;  ///< edge of a cell, in units
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

  /// A number from 0 to N-1; each has as many cells as any other, give or take one.
  [[nodiscard]] std::uint64_t rank(Index3 cell) const {
    const auto index = static_cast<std::uint64_t>(Box3{{}, count}.offset(cell));
    const auto cells = static_cast<std::uint64_t>(count.product());
    if (cells <= labels) return index;
    return static_cast<std::uint64_t>(Wide{index} * labels / cells);
  }
  /// Whether the cell is the first of its rank; only such cells have tubes and balls, one a label.
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

/// Each fills out with the voxels of slab, which are whole planes of the volume, x fastest.
void synth_voronoi(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out);
void synth_tubes(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out);
void synth_spheres(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out);

}  // namespace mw
