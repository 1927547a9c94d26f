// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the tetrahedra of an FEBio model.
#pragma once

#include "io/file/byte_source.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Sections Nodes and Elements (tet4, tet10) of Mesh (febio_spec 3.0 and 4.0) or Geometry (2.5),
/// in this file, not in one that it includes.  The label of a part is the id of its material,
/// through M.feb.labels.csv where there is one.  Of tets with ten nodes the corners are read; the
/// middles of edges go.  The XML is parsed whole: memory is some ten times the file.
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for elements that are
/// not tetrahedra, a part without material, or a node that does not exist.
[[nodiscard]] MeshData read_febio(const ByteSource& source);

}  // namespace mw::io
