// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a window works on: gathered from blocks, and scattered to blocks again.
#pragma once

#include <vector>

#include "engine/window/window_grid.h"
#include "kernels/distance/carried_samples.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw::engine {

/// What a window works on.
struct WindowContent {
  TetMesh mesh;
  CarriedSamples samples;
  bool one_label = false;  ///< there is no interface
};

/// The far corner of a volume, in lattice units.
[[nodiscard]] Point lattice_corner(Index3 volume);

/// Merges blocks into the content of a window, as merge_blocks() does; `inner` are planes beyond
/// which there is a copy of the volume, instead of the exterior.
[[nodiscard]] WindowContent gather(std::vector<BlockMesh> blocks, Index3 volume,
                                   BoxPlanes inner = 0);

/// Deals the tets of a window to the owner blocks of their barycentres; samples go with the tet on
/// the side of their triangle's smaller label.  Returns canonical blocks in the order of
/// grid.blocks_of(window).
[[nodiscard]] std::vector<BlockMesh> scatter(const WindowContent& content, const WindowGrid& grid,
                                             Index3 window);

/// Returns the box of the voxels that the content of a window reaches into, and `halo` around them.
[[nodiscard]] Box3 voxels_around(const TetMesh& mesh, std::int64_t halo);

}  // namespace mw::engine
