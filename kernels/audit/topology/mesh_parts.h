// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The face-connected parts of all labels of a mesh, and what touches the exterior.
#pragma once

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/topology/parts.h"

namespace mw::audit {

/// Class of a tet: a label of the volume (they are below `exterior`), or exterior + 1 for all
/// labels that are not the volume's.
[[nodiscard]] inline Label class_of_tet(const MeshStars& stars, Label exterior, std::uint32_t tet) {
  const Label label = stars.mesh().labels[tet];
  return label < exterior ? label : exterior + 1;
}

/// Parts of a tile's tets by class.  Member tet_count is the exterior; tets that name a vertex
/// twice are counted to it.  Cost: one sort of the triangles at each vertex.
[[nodiscard]] Parts parts_of_mesh(const MeshStars& stars, Label exterior);

/// Vertices and edges on the exterior: those of triangles that have one tet and an owned vertex.
struct BoxCells {
  std::vector<bool> vertices;
  std::vector<std::uint64_t> edges;  ///< ascending, smaller vertex in the high half
};

/// Cost: as parts_of_mesh.
[[nodiscard]] BoxCells box_cells(const MeshStars& stars);

}  // namespace mw::audit
