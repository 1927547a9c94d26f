// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes of the library as io has them.
#pragma once

#include "engine/mwmesh.h"
#include "io/mesh/mesh_data.h"

namespace mw::api {

/// Without a report.
[[nodiscard]] mwmesh::Mesh library_mesh(io::MeshData&& mesh);

/// Begin to finish.  ERRORS: mw::Error(kUsage) for lists that do not fit together.
void deliver(const mwmesh::Mesh& mesh, io::MeshSink& sink);

}  // namespace mw::api
