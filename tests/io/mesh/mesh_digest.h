// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The digest of a mesh in memory.
#pragma once

#include "io/mesh/digest.h"
#include "io/mesh/mesh_data.h"

namespace mw::io {

/// REQUIRES: rows within vertices.
[[nodiscard]] inline std::string mesh_digest(const MeshData& mesh) {
  DigestSink sink(scratch_folder());
  write_mesh(mesh, sink);
  return sink.digest();
}

}  // namespace mw::io
