// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the mesh of an Abaqus input file.
#pragma once

#include <filesystem>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// Takes *NODE and the tets of *ELEMENT (C3D4, C3D10 and their kin: corners alone) and skips other
/// elements and keywords.  Rows are nodes by their numbers.  A tet's label is that of its ELSET,
/// else of the first *ELSET that has it (labels_of_sets); names in comments of our own win.
/// Instances of parts are not moved.  May be gzipped.
/// ERRORS: mw::Error(kInput) with file and line; also for nodes or elements that the file does not
/// list (*INCLUDE, INPUT=, *NGEN, *ELCOPY, ..), systems of coordinates, and two parts whose nodes
/// have the same numbers.
[[nodiscard]] MeshData read_inp(const std::filesystem::path& path);

}  // namespace mw::io
