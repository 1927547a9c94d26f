// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All passes over a finished mesh, in the order in which they work.
#pragma once

#include <optional>
#include <utility>
#include <vector>

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

/// Applies the passes that are asked, in their order.
[[nodiscard]] FinishFacts apply_passes(io::ScratchMesh& mesh, const FinishTask& task);

/// Takes a mesh in; once it is whole, applies the passes and gives it to the sinks, one after the
/// other.  REQUIRES: mesh, task and sinks outlive it.
class FinishSink : public io::ScratchMeshSink {
 public:
  FinishSink(io::ScratchMesh& mesh, const FinishTask& task, std::vector<io::MeshSink*> sinks)
      : ScratchMeshSink(mesh, [this] { complete(); }),
        mesh_(mesh),
        task_(task),
        sinks_(std::move(sinks)) {}

  /// Returns nothing before finish().
  [[nodiscard]] const std::optional<FinishFacts>& facts() const { return facts_; }
  /// Returns the most that mesh and passes hold, or mesh and sinks.
  [[nodiscard]] std::uint64_t buffer_bytes() const override;

 private:
  void complete();

  io::ScratchMesh& mesh_;
  const FinishTask& task_;
  std::vector<io::MeshSink*> sinks_;
  std::optional<FinishFacts> facts_;
};

}  // namespace mw::engine
