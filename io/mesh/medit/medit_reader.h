// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads an ASCII MEDIT .mesh file.
#pragma once

#include "io/file/source/byte_source.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Takes Vertices and Tetrahedra and skips every other section; labels are signed when one of them
/// is negative.
/// ERRORS: mw::Error(kInput) with file and line when truncated, not of dimension 3, without
/// vertices or tetrahedra, or when a row does not exist.
[[nodiscard]] MeshData read_medit(const ByteSource& source);

}  // namespace mw::io
