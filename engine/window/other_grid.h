// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks of a volume that repeats itself, as grids that begin elsewhere have them.
#pragma once

#include "engine/window/window_grid.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// A block and the grid that it is one of.
struct BlockOfGrid {
  const WindowGrid& grid;
  Index3 block;
};

/// Returns the content of a block as it is in another grid of the same volume, in a block that
/// holds it: places and samples move by whole periods.
///
/// A vertex in a plane where the volume ends is two vertices, one at each end, in a grid that
/// begins there, and one vertex in a grid that begins elsewhere; ids follow.  In such a grid a
/// vertex may be in two places, at either end of the grid, where it has two ids; neither end of the
/// grid lets it move, so that it remains the same. REQUIRES: canonical; no tet crosses a plane
/// where the volume ends. ENSURES: canonical, and equal to `content` where both grids begin at the
/// volume's corner.
[[nodiscard]] BlockMesh in_other_grid(BlockMesh content, const BlockOfGrid& from,
                                      const BlockOfGrid& to);

}  // namespace mw::engine
