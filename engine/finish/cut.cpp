// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/cut.h"

#include <utility>

#include "io/mesh/grouped/grouped_sink.h"

namespace mw::engine {
namespace {

/// The next mesh has buffers, too.
constexpr std::uint64_t kCutBytes = io::GroupedSink::kMostBytes + io::ScratchMesh::kBufferBytes;

}  // namespace

void cut(io::ScratchMesh& mesh, const CutTask& task, const std::function<void()>& between) {
  for (int i = 0; i < task.times; ++i) {
    io::ScratchMesh next(mesh.folder());
    io::ScratchMeshSink into(next);
    io::halve(mesh, into, task.curves, between);
    mesh = std::move(next);
  }
}

std::uint64_t bytes_to_cut() {
  return kCutBytes;
}

}  // namespace mw::engine
