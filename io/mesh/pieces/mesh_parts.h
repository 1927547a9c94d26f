// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which tets of a mesh go into which of several pieces.
#pragma once

#include <vector>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Rows of tets by piece, ascending.  Boxes around the barycentres are halved again and again
/// across their longest side, so pieces are compact; they have as many tets as each other, give or
/// take one.  A function of the mesh and the number: ties go by row. REQUIRES: 1 <= pieces <= tets.
/// Memory: 40 bytes a tet.  Cost: O(tets log pieces).
[[nodiscard]] std::vector<std::vector<std::uint64_t>> mesh_parts(const MeshData& mesh,
                                                                 std::uint64_t pieces);

}  // namespace mw::io
