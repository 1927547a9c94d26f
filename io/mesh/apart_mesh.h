// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a mesh in a process of its own.
#pragma once

#include <functional>
#include <string>

#include "io/file/wall/apart.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// The most rows that a reader in a child process may write at once.
inline constexpr std::uint64_t kMaxApartRows = 1 << 16;

/// Runs read in a child and passes on to sink what it writes, except finish(): the caller does that
/// once it is known that all went well.
/// ENSURES: returns how the child died, nothing when it finished the mesh; tets name vertices that
/// sink has been given, whatever the child sends.  Memory: a batch of rows.
/// ERRORS: those of read and of sink; kResource when there can be no child.
[[nodiscard]] std::string pass_mesh_apart(const ApartLimits& limits,
                                          const std::function<void(MeshSink&)>& read,
                                          MeshSink& sink);

}  // namespace mw::io
