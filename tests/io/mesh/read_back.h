// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads what the writers of solvers' formats wrote: with code of the tests for formats that the
// product does not read.
#pragma once

#include "io/mesh/open_mesh.h"

namespace mw::io {

/// The mesh of a file in any format that is written.  Expects middles of edges in the middle of
/// the corners that VTK's order names, behind all vertices; they are no part of what is returned.
[[nodiscard]] MeshData read_back(const std::filesystem::path& path);

/// All numbers of a data set of an HDF5 file.  T: double or std::int64_t.
template <class T>
[[nodiscard]] std::vector<T> hdf5_numbers(const std::filesystem::path& file, const char* data_set);

}  // namespace mw::io
