// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A whole mesh in memory, as verify, digest, info and convert read it.
#pragma once

#include <vector>

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Vertices by row, tets by vertex rows, one raw label a tet.
struct MeshData {
  std::vector<Position> vertices;
  std::vector<TetRows> tets;
  std::vector<RawLabel> labels;
  bool labels_signed = false;
};

}  // namespace mw::io
