// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads TetGen's .node and .ele files.
#pragma once

#include <filesystem>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// M.node and M.ele beside it; rows count from 0 or 1, as the first node says.  The label is the
/// first attribute of a tet, through M.node.labels.csv where there is one.  Of tets with ten nodes
/// the corners are read; the middles of edges go.
/// ERRORS: mw::Error(kInput) with file and line when one of the two is missing, truncated or
/// corrupt, when tets have no attribute, or one that is no integer, or a row does not exist.
[[nodiscard]] MeshData read_tetgen(const std::filesystem::path& nodes);

}  // namespace mw::io
