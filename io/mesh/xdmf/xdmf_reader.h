// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tetrahedral XDMF file over HDF5, ours or another tool's.
#pragma once

#include <filesystem>

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// XDMF 2 or 3 with uniform grids whose numbers are in HDF5 files beside it, as we, dolfinx and
/// meshio (data_format "HDF") write them.  The first grid of tetrahedra with an integer cell
/// attribute is read; nodes are its own, or those of the first grid that has some.  The label is
/// the attribute `label`, else `Label`, `labels`, `material` or `medit:ref`, else the only integer
/// one.  Names come from M.xdmf.labels.csv.  Of tets with ten nodes the corners are read.
/// The HDF5 library reads in a child process: damaged files crash it.
/// Memory: as read_vtkhdf().
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for numbers that are
/// elsewhere (inline, binary), without tetrahedra or label, or when a row does not exist.
void read_xdmf(const std::filesystem::path& path, MeshSink& sink);

}  // namespace mw::io
