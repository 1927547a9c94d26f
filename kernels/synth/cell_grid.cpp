// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The grid of cubic cells in which the synthetic objects sit.
#include "kernels/synth/cell_grid.h"

namespace mw {
namespace {

Index3 cells_of_edge(Index3 shape, std::int64_t edge, CellFit fit, bool flat) {
  const std::int64_t extra = fit == CellFit::kCover ? edge - 1 : 0;
  const auto along = [&](std::int64_t voxels) { return (voxels * kSynthUnits + extra) / edge; };
  return {along(shape.x), along(shape.y), flat ? 1 : along(shape.z)};
}

}  // namespace

CellGrid make_cell_grid(Index3 shape, std::uint64_t labels, CellFit fit, bool flat) {
  std::int64_t low = kSynthUnits;  // always taken
  std::int64_t high = std::max({shape.x, shape.y, shape.z}) * kSynthUnits + 1;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    const Index3 count = cells_of_edge(shape, middle, fit, flat);
    (static_cast<std::uint64_t>(count.product()) >= labels ? low : high) = middle;
  }
  return {.edge = low, .count = cells_of_edge(shape, low, fit, flat), .labels = labels};
}

}  // namespace mw
