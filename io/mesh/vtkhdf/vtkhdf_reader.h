// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tetrahedral .vtkhdf file, ours or another tool's.
#pragma once

#include <filesystem>

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// VTKHDF of type UnstructuredGrid, version 1 or 2 (one time step); partitions are put one after
/// the other.  The label is the cell array `label`, else `Label`, `labels`, `material` or
/// `medit:ref`, else the only integer cell array.
/// The HDF5 library reads in a child process: damaged files crash it.
/// Of tets with ten nodes the corners are read; the middles of edges go.
/// Memory: batches of 65,536 rows, whatever the size of the mesh; of one with ten-node tets a
/// quarter of a byte a node as well.
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for cells that are not
/// tetrahedra, without label, or when a row does not exist; what the sink throws.
void read_vtkhdf(const std::filesystem::path& path, MeshSink& sink);

}  // namespace mw::io
