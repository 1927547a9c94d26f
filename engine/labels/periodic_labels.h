// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells that repeat themselves: the same start mesh on opposite faces, then marches over these.
#pragma once

#include <array>
#include <functional>

#include "engine/settings/settings.h"
#include "kernels/core/label.h"
#include "kernels/mesh/block_mesh.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw::engine {

/// Returns how far a cell's copies around it are seen, in voxels; 0 along axes that are not
/// periodic.
///
/// A start mesh is a function of the labels around it and of where its octree cells begin, modulo
/// their size.  So it is made from the cell with its copies around it, and opposite faces of the
/// cell get the same mesh.  The margin is more than what the largest cells of the octree depend on.
[[nodiscard]] Index3 periodic_margin(const MeshSettings& settings);

/// Returns the largest level of cells, at most `level`, whose pattern of diagonals repeats itself
/// with the volume: twice the cell's edge divides the volume's edge along each periodic axis.
[[nodiscard]] int periodic_level(Index3 shape, const MeshSettings& settings, int level);

/// Returns the planes beyond which a copy of the volume lies, instead of the exterior.
[[nodiscard]] BoxPlanes inner_planes(const MeshSettings& settings);

/// Returns the most that the edge of windows may be: along periodic axes there are three
/// blocks.
[[nodiscard]] int largest_window(Index3 shape, const MeshSettings& settings);

/// Calls visit(part, by) for the parts of a box in the cell and in its copies, along axes where it
/// repeats itself: part - by is in the cell.
void each_copy(const Box3& box, Index3 cell, std::array<bool, 3> repeats,
               const std::function<void(const Box3& part, Index3 by)>& visit);

/// Returns the labels of a box, which may reach into copies of the cell along axes where it repeats
/// itself; along the others it is cut off at the cell.  labels_of is called with boxes in the cell.
[[nodiscard]] LabelBox repeated_labels(const Box3& box, Index3 cell, std::array<bool, 3> repeats,
                                       const std::function<LabelBox(const Box3&)>& labels_of);

/// Gives labels of copies around a cell the side of theirs (kFirstSide): every other copy along an
/// axis has one.  The box's places are relative to the cell.
void give_sides(LabelBox& labels, Index3 cell);

/// Returns a start mesh that was made in a volume with this margin as it is in the volume without.
[[nodiscard]] BlockMesh without_margin(BlockMesh mesh, Index3 volume, Index3 margin);

}  // namespace mw::engine
