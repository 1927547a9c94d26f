// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The digest of a mesh's content, the same for every file the mesh is stored in.
#pragma once

#include <string>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// "sha256:<64 hex digits>" of these bytes, all numbers little-endian:
///   "mwmesh-digest-1"                 15 ASCII characters, no NUL
///   number of vertices, of tets       2 x uint64
///   vertices                          3 x float64 each, sorted by (x, y, z); -0.0 as 0.0
///   tets                              4 x uint64 ranks in ascending order, then uint64 label,
///                                     each; sorted by these five numbers
/// The rank of a vertex is the number of vertices whose position sorts before its own, so vertices
/// at one position share a rank.  Independent of the order of rows, the orientation of tets, the
/// signedness of labels and the format.
/// REQUIRES: rows within vertices.  Cost: O(n log n), about twice the mesh's memory.
[[nodiscard]] std::string mesh_digest(const MeshData& mesh);

}  // namespace mw::io
