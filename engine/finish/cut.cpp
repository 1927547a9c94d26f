// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/cut.h"

#include <utility>

namespace mw::engine {
namespace {

/// What GroupedSink::buffer_bytes() says of ten nodes with curves, and the next mesh's buffers.
constexpr std::uint64_t kCutBytes = (std::uint64_t{136} << 20U) + io::ScratchMesh::kBufferBytes;

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
