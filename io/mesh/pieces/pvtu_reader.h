// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a mesh in pieces as one.
#pragma once

#include <filesystem>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// The .vtu files that a .pvtu names, in its folder or below, put together: vertices by ascending
/// PointData/GlobalNodeIds, tets piece by piece, names of labels from all.  A single piece needs no
/// ids.  Of what PvtuSink wrote it is the mesh again, but for the order of tets.
/// Memory: the mesh, and 24 bytes a vertex of a piece.
/// ERRORS: mw::Error(kInput) with file and place as read_vtu(); for pieces that overlap (ghost
/// cells), without ids, or with tets of ten nodes, and for an id at two places.
[[nodiscard]] MeshData read_pvtu(const std::filesystem::path& path);

}  // namespace mw::io
