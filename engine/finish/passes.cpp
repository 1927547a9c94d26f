// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/finish/passes.h"

#include <algorithm>
#include <array>

#include "engine/finish/curve.h"
#include "engine/finish/sample.h"
#include "engine/finish/select_labels.h"

namespace mw::engine {
namespace {

/// Returns how passes look at tets, in the memory that parts have for the same.
TetWork tet_work(const FinishTask& task) {
  return {.how = WorkInOrder::within(task.connect.threads, task.connect.work_bytes,
                                     TetWork::kRangeBytes),
          .between = task.between};
}

std::uint64_t bytes_of_ranges(const FinishTask& task) {
  return TetWork::kRangeBytes * tet_work(task).how.at_once;
}

/// A row here and a field of FinishTask make a pass.  The order is the order of work.
constexpr std::array kPasses{
    Pass{.name = "labels left out",
         .is_asked =
             [](const FinishTask& task) { return task.labels.labels || task.labels.background; },
         .bytes = [](const FinishTask&) { return io::ScratchMesh::kBufferBytes; },
         .apply = [](io::ScratchMesh& mesh, const FinishTask& task,
                     FinishFacts&) { select_labels(mesh, task.labels, task.between); }},
    Pass{.name = "cut",
         .is_asked = [](const FinishTask& task) { return task.cut.times > 0; },
         .bytes = [](const FinishTask&) { return bytes_to_cut(); },
         .apply = [](io::ScratchMesh& mesh, const FinishTask& task,
                     FinishFacts&) { cut(mesh, task.cut, task.between); }},
    // The certificate is about what the marches made, before parts are left out on purpose.
    Pass{.name = "certificate",
         .is_asked = [](const FinishTask& task) { return task.certificate.has_value(); },
         .bytes = [](const FinishTask& task) { return task.certificate->memory_bytes; },
         .apply =
             [](io::ScratchMesh& mesh, const FinishTask& task, FinishFacts& facts) {
               facts.certificate = certify(mesh, *task.certificate, task.between);
             }},
    Pass{.name = "parts",
         .is_asked =
             [](const FinishTask& task) {
               return task.finds_parts || task.connect.options.change_mesh();
             },
         .bytes = [](const FinishTask& task) { return bytes_to_connect(task.connect); },
         .apply =
             [](io::ScratchMesh& mesh, const FinishTask& task, FinishFacts& facts) {
               facts.connected = connect(mesh, task.connect, task.between);
             }},
    Pass{.name = "sample",
         .is_asked = [](const FinishTask& task) { return task.samples != nullptr; },
         .bytes =
             [](const FinishTask& task) {
               return bytes_to_sample(*task.samples, task.connect.memory_bytes);
             },
         .apply =
             [](io::ScratchMesh& mesh, const FinishTask& task, FinishFacts&) {
               sample(mesh, *task.samples, task.connect.memory_bytes, task.between);
             }},
    Pass{.name = "edges",
         .is_asked = [](const FinishTask& task) { return task.edges.has_value(); },
         .bytes = [](const FinishTask& task) { return bytes_of_edges() + bytes_of_ranges(task); },
         .apply =
             [](io::ScratchMesh& mesh, const FinishTask& task, FinishFacts& facts) {
               facts.edges = measure_edges(mesh, *task.edges, tet_work(task));
             }},
    Pass{.name = "volumes",
         .is_asked = [](const FinishTask& task) { return task.volumes.has_value(); },
         .bytes = bytes_of_ranges,
         .apply =
             [](io::ScratchMesh& mesh, const FinishTask& task, FinishFacts& facts) {
               facts.amounts = label_amounts(mesh, *task.volumes, tet_work(task));
             }},
    Pass{.name = "figures",
         .is_asked = [](const FinishTask& task) { return task.figures.has_value(); },
         .bytes =
             [](const FinishTask& task) {
               return bytes_to_measure(*task.figures) + bytes_of_ranges(task);
             },
         .apply =
             [](io::ScratchMesh& mesh, const FinishTask& task, FinishFacts& facts) {
               facts.figures = measure(mesh, *task.figures, tet_work(task));
             }},
    Pass{.name = "values left out",
         .is_asked = [](const FinishTask& task) { return task.leaves_values_out; },
         .bytes = [](const FinishTask&) { return std::uint64_t{0}; },
         .apply = [](io::ScratchMesh& mesh, const FinishTask&,
                     FinishFacts&) { mesh.drop_values(); }},
    Pass{.name = "curves",
         .is_asked = [](const FinishTask& task) { return task.is_curved; },
         .bytes = [](const FinishTask&) { return bytes_to_curve(); },
         .apply = [](io::ScratchMesh& mesh, const FinishTask& task,
                     FinishFacts&) { curve(mesh, task.between); }},
};

}  // namespace

FinishFacts apply_passes(io::ScratchMesh& mesh, const FinishTask& task,
                         std::span<io::MeshSink* const> sinks) {
  const auto end_stage = [&](const char* name) {
    if (task.stages != nullptr) task.stages->end(name);
  };
  FinishFacts out;
  end_stage("output");
  for (const Pass& pass : kPasses) {
    if (!pass.is_asked(task)) continue;
    pass.apply(mesh, task, out);
    end_stage(pass.name);
  }
  out.vertices = mesh.vertex_count();
  out.tets = mesh.tet_count();
  for (io::MeshSink* sink : sinks) mesh.copy_to(*sink, task.between);
  end_stage("file");
  return out;
}

std::uint64_t bytes_to_finish(const FinishTask& task, std::span<io::MeshSink* const> sinks) {
  std::uint64_t of_passes = 0, of_sinks = 0;
  for (const Pass& pass : kPasses) {
    if (pass.is_asked(task)) of_passes = std::max(of_passes, pass.bytes(task));
  }
  for (const io::MeshSink* sink : sinks) of_sinks += sink->buffer_bytes();
  return io::ScratchMesh::kBufferBytes + std::max(of_passes, of_sinks);
}

}  // namespace mw::engine
