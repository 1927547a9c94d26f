// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells that repeat themselves: the same start mesh on opposite faces.
#pragma once

#include "engine/settings/settings.h"
#include "kernels/mesh/block_mesh.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw::engine {

/// How much of a cell's copies is seen around it, in voxels; along axes that are not periodic 0.
///
/// A start mesh follows from the labels around it, wherever these are, as far as the places of its
/// cells are the same multiples of their size.  So it is made of the cell with its copies around
/// it: what one face of the cell has, the opposite one has as well.  Vertices on these faces stay
/// as they are; all marches work inside.  The margin is more than what the largest cells of the
/// octree depend on.
[[nodiscard]] Index3 periodic_margin(const MeshSettings& settings);

/// The largest level of cells, at most `level`, whose pattern of diagonals repeats itself with the
/// volume: twice its edge divides the volume's along each periodic axis.
[[nodiscard]] int periodic_level(Index3 shape, const MeshSettings& settings, int level);

/// The planes of the volume whose vertices stay.
[[nodiscard]] BoxPlanes periodic_planes(const MeshSettings& settings);

/// A start mesh that was made in a volume with that margin, as it is in the volume without.
[[nodiscard]] BlockMesh without_margin(BlockMesh mesh, Index3 volume, Index3 margin);

/// ERRORS: mw::Error(kUsage) when an axis that repeats itself has an odd number of voxels: the
///         paper's five tets a voxel need an even one.
void check_periodic(Index3 shape, const MeshSettings& settings);

}  // namespace mw::engine
