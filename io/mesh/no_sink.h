// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sink for callers that want to know something of a mesh, but not to keep it.
#pragma once

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Takes a mesh and writes nothing; what derives from it looks at a part of the mesh.
class NoSink : public MeshSink {
 public:
  void begin(const MeshHeader& /*header*/) override {}
  void write_vertices(std::span<const Position> /*positions*/) override {}
  void write_tets(std::span<const TetRows> /*tets*/,
                  std::span<const RawLabel> /*labels*/) override {}
  void finish() override {}
};

}  // namespace mw::io
