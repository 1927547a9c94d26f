// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes meshes of every format there is, chosen by extension.
#pragma once

#include <filesystem>
#include <memory>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// .vtkhdf, .vtu and .mesh.  ERRORS: mw::Error(kUsage) for another extension; kInput with file and
/// place when missing, truncated, corrupt or not of tetrahedra.
[[nodiscard]] MeshData read_mesh(const std::filesystem::path& path);

/// The same into a sink, begin to finish; .vtkhdf in bounded memory, the others by way of MeshData.
void copy_mesh(const std::filesystem::path& path, MeshSink& sink);

/// ERRORS: mw::Error(kUsage) for another extension or a path that cannot be written.
[[nodiscard]] std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& path);

}  // namespace mw::io
