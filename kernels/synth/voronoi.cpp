// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voronoi grains of a jittered grid of seeds.
#include <array>

#include "kernels/synth/cell_walk.h"
#include "kernels/synth/counter_hash.h"
#include "kernels/synth/synth_kinds.h"

namespace mw {
namespace {

struct Seeds {
  std::array<Index3, 27> at;  ///< in units
  std::array<RawLabel, 27> label;
  std::size_t count = 0;
};

/// Seeds keep to the middle 3/7 of their cells.  A voxel is then at most sqrt(3) * 5/7 = 1.24 edges
/// from its own cell's seed and at least 1.28 from seeds two cells away: the 27 cells around are
/// enough.
Index3 seed_of(const CellGrid& grid, std::uint64_t seed, Index3 cell) {
  const std::uint64_t h = hash_position(seed, cell);
  const std::int64_t lo = (2 * grid.edge + 6) / 7;
  const std::int64_t hi = 5 * grid.edge / 7 + 1;
  return {cell.x * grid.edge + pick(h, lo, hi), cell.y * grid.edge + pick(mix_bits(h), lo, hi),
          cell.z * grid.edge + pick(mix_bits(h + 1), lo, hi)};
}

/// In ascending order of cells, so that a tie has the same winner seen from every cell.
Seeds seeds_around(const CellGrid& grid, std::uint64_t seed, Index3 cell) {
  Seeds seeds;
  for (std::int64_t z = cell.z - 1; z <= cell.z + 1; ++z) {
    for (std::int64_t y = cell.y - 1; y <= cell.y + 1; ++y) {
      for (std::int64_t x = cell.x - 1; x <= cell.x + 1; ++x) {
        if (!grid.contains({x, y, z})) continue;
        seeds.at[seeds.count] = seed_of(grid, seed, {x, y, z});
        seeds.label[seeds.count++] = grid.rank({x, y, z}) + 1;
      }
    }
  }
  return seeds;
}

void fill_row(const Seeds& seeds, Index3 first, std::int64_t count, RawLabel* out) {
  std::array<std::int64_t, 27> base{};
  for (std::size_t k = 0; k < seeds.count; ++k) {
    base[k] = squared_distance(first.y, seeds.at[k].y) + squared_distance(first.z, seeds.at[k].z);
  }
  for (std::int64_t i = 0; i < count; ++i) {
    std::size_t nearest = 0;
    std::int64_t min = base[0] + squared_distance(first.x + i, seeds.at[0].x);
    for (std::size_t k = 1; k < seeds.count; ++k) {
      const std::int64_t distance = base[k] + squared_distance(first.x + i, seeds.at[k].x);
      nearest = distance < min ? k : nearest;
      min = std::min(distance, min);
    }
    out[i] = seeds.label[nearest];
  }
}

}  // namespace

void synth_voronoi(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out) {
  const CellGrid grid = make_cell_grid(spec.shape, spec.labels, CellFit::kCover, false);
  for_each_cell(grid, slab, [&](Index3 cell, const Box3& box) {
    const Seeds seeds = seeds_around(grid, spec.seed, cell);
    for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
      for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
        const Index3 first{box.lo.x, y, z};
        fill_row(seeds, first, box.shape().x, out.data() + slab.offset(first));
      }
    }
  });
}

}  // namespace mw
