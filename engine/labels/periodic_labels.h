// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells that repeat themselves have the same start mesh on opposite faces.
#pragma once

#include "engine/settings/settings.h"
#include "kernels/mesh/block_mesh.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw::engine {

/// Returns how far a cell's copies around it are seen, in voxels; 0 along axes that are not
/// periodic.
///
/// A start mesh is a function of the labels around it and of where its octree cells begin, modulo
/// their size.  So it is made from the cell with its copies around it, and opposite faces of the
/// cell get the same mesh.  Vertices on these faces stay as they are; all marches work inside.  The
/// margin is more than what the largest cells of the octree depend on.
[[nodiscard]] Index3 periodic_margin(const MeshSettings& settings);

/// Returns the largest level of cells, at most `level`, whose pattern of diagonals repeats itself
/// with the volume: twice the cell's edge divides the volume's edge along each periodic axis.
[[nodiscard]] int periodic_level(Index3 shape, const MeshSettings& settings, int level);

/// Returns the planes of the volume whose vertices stay.
[[nodiscard]] BoxPlanes periodic_planes(const MeshSettings& settings);

/// Returns a start mesh that was made in a volume with this margin as it is in the volume without.
[[nodiscard]] BlockMesh without_margin(BlockMesh mesh, Index3 volume, Index3 margin);

/// ERRORS: mw::Error(kUsage) when an axis that repeats itself has an odd number of voxels: the
///         paper's five tets a voxel need an even one.
void check_periodic(Index3 shape, const MeshSettings& settings);

}  // namespace mw::engine
