// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/curve.h"

#include "io/mesh/grouped/grouped_sink.h"

namespace mw::engine {

void curve(io::ScratchMesh& mesh, const std::function<void()>& between) {
  io::GroupedSink grouped(mesh.folder(), nullptr, io::Element::kCurvedTet10);
  static_cast<void>(grouped.view(mesh, between));
  mesh.curve(grouped.take_nodes());
}

std::uint64_t bytes_to_curve() {
  return io::GroupedSink::kMostBytes;
}

}  // namespace mw::engine
