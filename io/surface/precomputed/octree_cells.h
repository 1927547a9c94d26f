// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A surface cut into the cells of a grid, as one level of an octree has them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/surface/surface_sink.h"
#include "kernels/core/index.h"

namespace mw::io {

/// The bits of a coordinate within a cell; the format allows 10 or 16.
inline constexpr int kDracoBits = 16;

/// The steps along the edge of a cell.
inline constexpr std::int64_t kCellSteps = (1 << kDracoBits) - 1;

/// Where neuroglancer cuts the cell of a coarse level into eight, in steps.
inline constexpr std::int64_t kHalfCell = (kCellSteps + 1) / 2;

/// A place in steps.
using Steps = std::array<std::int64_t, 3>;

struct SteppedSurface {
  std::vector<Steps> vertices;
  std::vector<Triangle> triangles;
};

/// The part of a surface that lies in one cell.
struct CellPart {
  Index3 cell;
  SteppedSurface surface;  ///< from the cell's least corner, within 0 to kCellSteps
};

/// Cuts triangles along the planes between cells, and with halves also along those that cut cells
/// into eight.  A triangle in the plane between two cells goes to the one above it.
/// REQUIRES: vertices are within 0 and kCellSteps times the grid's extents, each of which is at
/// least 1 and at most 2^14.
/// ENSURES: parts have triangles and ascend by the compressed Morton code of their cells; new
/// vertices are within half a step of the edge that they cut, and triangles that share an edge
/// share them; all other vertices stay where they were.  Cost: O(n log n) in the triangles of the
/// parts.
[[nodiscard]] std::vector<CellPart> cut_into_cells(SteppedSurface surface, Index3 grid,
                                                   bool halves);

}  // namespace mw::io
