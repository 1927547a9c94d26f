// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes meshes of every format there is, chosen by extension.
#pragma once

#include <filesystem>
#include <memory>

#include "io/mesh/mesh_data.h"

namespace mw::io {

/// .vtu and .mesh.  ERRORS: mw::Error(kUsage) for another extension; kInput with file and place
/// when missing, truncated, corrupt or not of tetrahedra.
[[nodiscard]] MeshData read_mesh(const std::filesystem::path& path);

/// ERRORS: mw::Error(kUsage) for another extension or a path that cannot be written.
[[nodiscard]] std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& path);

/// Writes all of a mesh: begin to finish.
void write_mesh(const MeshData& mesh, MeshSink& sink);

}  // namespace mw::io
