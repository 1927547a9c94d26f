// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voronoi grains, tubes and balls, cell by cell.
#include "kernels/synth/cell_objects.h"

#include <algorithm>
#include <array>

namespace mw {
namespace {

Index3 cells_of_edge(Index3 shape, std::int64_t edge, CellFit fit, bool flat) {
  const std::int64_t extra = fit == CellFit::kCover ? edge - 1 : 0;
  const auto along = [&](std::int64_t voxels) { return (voxels * kSynthUnits + extra) / edge; };
  return {along(shape.x), along(shape.y), flat ? 1 : along(shape.z)};
}

struct Seeds {
  std::array<Index3, 27> at;  ///< in units
  std::array<RawLabel, 27> label;
  std::size_t count = 0;
};

/// Seeds keep to the middle 3/7 of their cells.  A voxel is then at most sqrt(3) * 5/7 = 1.24 edges
/// from its own cell's seed and at least 1.28 from seeds two cells away, so that the 27 cells
/// around are enough.
Index3 seed_of(const CellGrid& grid, std::uint64_t seed, Index3 cell) {
  const std::uint64_t h = hash_position(seed, cell);
  const std::int64_t lo = (2 * grid.edge + 6) / 7;
  const std::int64_t hi = 5 * grid.edge / 7 + 1;
  return {cell.x * grid.edge + pick(h, lo, hi), cell.y * grid.edge + pick(mix_bits(h), lo, hi),
          cell.z * grid.edge + pick(mix_bits(h + 1), lo, hi)};
}

/// Seeds ascend with their cells, so that a tie has the same winner seen from every cell.
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

/// Labels the voxels of one row whose squared distance to centre_x along x is at most squared_left,
/// which is what the other directions leave of the squared radius.
// More than five parameters: an innermost loop, which has its numbers in registers.
void mark_row(const Box3& box, Index3 first, std::int64_t centre_x, std::int64_t squared_left,
              RawLabel label, RawLabel* out) {
  if (squared_left < 0) return;
  for (std::int64_t x = box.lo.x; x < box.hi.x; ++x) {
    if (squared_distance(x, centre_x) <= squared_left) out[x - first.x] = label;
  }
}

/// Value at t of a curve through random values at 0, span, 2 span, ..., with smooth steps between.
std::int64_t wander(std::uint64_t key, std::int64_t t, std::int64_t span, std::int64_t amplitude) {
  constexpr std::int64_t kOne = 1 << 10;
  const std::int64_t knot = t / span;
  const std::int64_t u = (t % span) * kOne / span;
  const std::int64_t weight = u * u * (3 * kOne - 2 * u) / (kOne * kOne);  // 3u^2 - 2u^3
  const auto at = [&](std::int64_t k) {
    return pick(mix_bits(key + static_cast<std::uint64_t>(k)), -amplitude, amplitude + 1);
  };
  return (at(knot) * (kOne - weight) + at(knot + 1) * weight) / kOne;
}

/// A tube's section with a plane of voxels, in units.
struct Disc {
  std::int64_t x;
  std::int64_t y;
  std::int64_t squared_radius;
};

/// The radius and the wandering of a tube keep it inside its cell.
Disc tube_section(const CellGrid& grid, std::uint64_t key, Index3 cell, std::int64_t z) {
  const std::int64_t radius = grid.edge / 4;
  const std::int64_t amplitude = std::max<std::int64_t>(0, grid.edge / 2 - radius - kSynthUnits);
  const std::int64_t t = z * kSynthUnits;
  const std::int64_t span = 2 * grid.edge;
  return {cell.x * grid.edge + grid.edge / 2 + wander(key, t, span, amplitude),
          cell.y * grid.edge + grid.edge / 2 + wander(mix_bits(key), t, span, amplitude),
          radius * radius};
}

}  // namespace

CellGrid make_cell_grid(Index3 shape, std::uint64_t labels, CellFit fit, bool flat) {
  std::int64_t low = kSynthUnits;  // taken even if it leaves too few cells
  std::int64_t high = std::max({shape.x, shape.y, shape.z}) * kSynthUnits + 1;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    const Index3 count = cells_of_edge(shape, middle, fit, flat);
    (static_cast<std::uint64_t>(count.product()) >= labels ? low : high) = middle;
  }
  return {.edge = low, .count = cells_of_edge(shape, low, fit, flat), .labels = labels};
}

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

void synth_tubes(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out) {
  std::fill(out.begin(), out.end(), RawLabel{0});
  const CellGrid grid = make_cell_grid(spec.shape, spec.labels, CellFit::kInside, true);
  for (std::int64_t z = slab.lo.z; z < slab.hi.z; ++z) {
    const Box3 plane{{0, 0, 0}, {slab.hi.x, slab.hi.y, 1}};
    for_each_cell(grid, plane, [&](Index3 at, const Box3& box) {
      const Index3 cell{at.x, at.y, 0};
      if (!grid.contains(cell) || !grid.is_first(cell)) return;
      const Disc disc = tube_section(grid, hash_position(spec.seed, cell), cell, z);
      for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
        const Index3 first{box.lo.x, y, z};
        mark_row(box, first, disc.x, disc.squared_radius - squared_distance(y, disc.y),
                 grid.rank(cell) + 1, out.data() + slab.offset(first));
      }
    });
  }
}

void synth_spheres(const SynthSpec& spec, const Box3& slab, std::span<RawLabel> out) {
  std::fill(out.begin(), out.end(), RawLabel{0});
  const CellGrid grid = make_cell_grid(spec.shape, spec.labels, CellFit::kInside, false);
  for_each_cell(grid, slab, [&](Index3 cell, const Box3& box) {
    if (!grid.contains(cell) || !grid.is_first(cell)) return;
    const std::uint64_t h = hash_position(spec.seed, cell);
    const std::int64_t radius = pick(mix_bits(h + 2), grid.edge / 5, grid.edge * 9 / 20 + 1);
    const auto centre = [&](std::int64_t c, std::uint64_t key) {
      return c * grid.edge + pick(key, radius, grid.edge - radius + 1);
    };
    const Index3 at{centre(cell.x, h), centre(cell.y, mix_bits(h)),
                    centre(cell.z, mix_bits(h + 1))};
    for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
      for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
        const Index3 first{box.lo.x, y, z};
        const std::int64_t left =
            radius * radius - squared_distance(z, at.z) - squared_distance(y, at.y);
        mark_row(box, first, at.x, left, grid.rank(cell) + 1, out.data() + slab.offset(first));
      }
    }
  });
}

}  // namespace mw
