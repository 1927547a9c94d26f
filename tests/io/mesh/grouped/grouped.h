// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups a mesh of memory.
#pragma once

#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// REQUIRES: the sink was given nothing.
inline GroupedMesh& grouped(GroupedSink& sink, const MeshData& mesh) {
  write_mesh(mesh, sink);
  return sink.mesh();
}

}  // namespace mw::io
