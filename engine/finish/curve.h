// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The edges of a finished mesh become curves where interfaces are.
#pragma once

#include <cstdint>
#include <functional>

#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

/// Finds the nodes of curved tets (io/mesh/grouped/curved_nodes.h), which sinks of
/// io::Element::kCurvedTet10 write; all others get the straight mesh that it was.  Calls between(),
/// which may throw, often.
/// Memory: bytes_to_curve().  Disk: that of a GroupedSink; 24 bytes a node stay.
/// ERRORS: those of io::GroupedSink; mw::Error(kUsage) for a mesh with doubled vertices.
/// REQUIRES: the mesh is not in parts of curved tets.
void curve(io::ScratchMesh& mesh, const std::function<void()>& between);

/// Returns the most bytes that curve() holds beside the mesh.
[[nodiscard]] std::uint64_t bytes_to_curve();

}  // namespace mw::engine
