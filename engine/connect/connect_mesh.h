// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds what hangs together in a finished mesh, leaves parts out, doubles vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "engine/connect/connect_options.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

struct ConnectTask {
  ConnectOptions options{};
  std::size_t memory_bytes = kMaxMemoryBytes;  ///< of all sorts
  std::size_t work_bytes = kMaxMemoryBytes;    ///< of what threads look at
  int threads = 1;

  static constexpr std::size_t kMaxMemoryBytes = 8 << 20;
  /// Returns the part of a budget that sorts take.
  [[nodiscard]] static std::size_t memory_of(std::uint64_t budget);
  /// Returns the part of a budget that work on this many threads takes.
  [[nodiscard]] static std::size_t work_of(std::uint64_t budget, int threads);
};

/// Counts parts and hinges.  If the options change the mesh, kept vertices and tets keep their
/// order, and copies of vertices come behind the vertices.  Calls between(), which may throw,
/// often.
/// Memory: bytes_to_connect(); where parts are left out, 2 bits a vertex and 8 bytes a label more.
/// Disk: that of PartFinder; where the mesh changes, that of the mesh once more.
/// ERRORS: those of PartFinder::find() and ScratchMesh.
ConnectFacts connect(
    io::ScratchMesh& mesh, const ConnectTask& task, const std::function<void()>& between = [] {});

/// Returns the most bytes that connect() holds beside the mesh, except for what grows with it.
[[nodiscard]] std::uint64_t bytes_to_connect(const ConnectTask& task);

}  // namespace mw::engine
