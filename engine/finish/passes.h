// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All passes over a finished mesh, in the order in which they work.
#pragma once

#include <cstdint>
#include <span>

#include "engine/finish/finish_task.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::engine {

/// A step that changes a finished mesh or finds something out about it.
struct Pass {
  const char* name;
  bool (*is_asked)(const FinishTask& task);
  /// Returns the most bytes that it holds beside what the mesh holds.  REQUIRES: it is asked.
  std::uint64_t (*bytes)(const FinishTask& task);
  /// REQUIRES: it is asked.  ERRORS: those of ScratchMesh, and its own.
  void (*apply)(io::ScratchMesh& mesh, const FinishTask& task, FinishFacts& facts);
};

/// Applies the passes that are asked, in their order, and gives the mesh to the sinks, one after
/// the other.
[[nodiscard]] FinishFacts apply_passes(io::ScratchMesh& mesh, const FinishTask& task,
                                       std::span<io::MeshSink* const> sinks = {});

/// Returns the most that mesh and passes hold, or mesh and sinks.
[[nodiscard]] std::uint64_t bytes_to_finish(const FinishTask& task,
                                            std::span<io::MeshSink* const> sinks);

}  // namespace mw::engine
