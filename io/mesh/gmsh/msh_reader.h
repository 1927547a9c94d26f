// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a .msh file of Gmsh.
#pragma once

#include <filesystem>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Versions 4.1 and 2.2, text and binary of either byte order; may be gzipped.  Takes tets of every
/// order, of which corners alone, and skips other elements.  Rows are nodes by their tags.  The
/// label is the first physical group of the tet's volume, or the volume's tag where it is in none:
/// of that number, or what the table beside the file says (append_label_table).  Without a table,
/// names are those of physical volumes.
/// ERRORS: mw::Error(kInput) with file and place; also for other versions, partitioned meshes, and
/// elements of which none is a tet.
[[nodiscard]] MeshData read_msh(const std::filesystem::path& path);

}  // namespace mw::io
