// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tetrahedral .vtu file, ours or another tool's.
#pragma once

#include "io/file/source/byte_source.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Pieces are put one after the other.  Of tets with ten nodes the corners are read; the middles of
/// edges go.  The label is the cell array `label`, else `Label`,
/// `labels`, `material` or `medit:ref`, else the only integer cell array.
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for cells that are not
/// tetrahedra, without label, or when a row does not exist.
[[nodiscard]] MeshData read_vtu(const ByteSource& source);

/// A mesh that is part of another.
struct VtuPiece {
  MeshData mesh;
  std::vector<std::uint64_t> ids;  ///< of its vertices in the whole: PointData/GlobalNodeIds
};

/// ERRORS: as read_vtu(); without ids, or with tets of ten nodes.
[[nodiscard]] VtuPiece read_vtu_piece(const ByteSource& source);

}  // namespace mw::io
