// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From volume and mesh to a verdict.
#include "engine/job/verify_job.h"

#include <algorithm>

#include "engine/labels/label_scan.h"
#include "engine/march/march.h"
#include "engine/verify/verify_mesh.h"
#include "kernels/core/layers.h"

namespace mw::engine {

report::Verdict verify(const VerifyJob& job, const std::function<void(io::MeshSink&)>& deliver) {
  const io::PreparedInput input(job.volume, job.steps, io::SpeckLimits::of_budget(job.memory));
  const io::LabelVolume& volume = input.volume();
  const io::VolumeInfo& info = volume.info();
  report::Verdict verdict{
      .specks = input.specks(), .table = collect_labels(volume, job.threads), .names = info.names};
  MeshTiles mesh(info, verdict.table, {job.folder, job.memory / 8});
  deliver(mesh);
  verdict.bounds = job.bounds(mesh.header().record);
  VerifyTask task{.options = audit_options(verdict.bounds.promises, info.space, job.checks),
                  .threads = thread_count(job.threads),
                  .memory_bytes = job.memory / 2,
                  .folder = job.folder,
                  .between = job.between};
  task.options.kept = kept_labels(job.choice, verdict.table);
  verdict.layers = task.options.layers;
  verdict.audit = verify_mesh(io::DenseVolume(volume, verdict.table), mesh, task);
  return verdict;
}

audit::KeptLabels kept_labels(const LabelChoice& choice, const io::LabelTable& table) {
  const engine::WantedLabel wanted = wanted_labels(choice, table);
  audit::KeptLabels kept;
  for (Label label = 0; wanted && label < table.size(); ++label) {
    kept.push_back(wanted(table.raw(label)));
  }
  const bool leaves_out = std::find(kept.begin(), kept.end(), false) != kept.end();
  return leaves_out ? kept : audit::KeptLabels{};
}

audit::AuditOptions audit_options(const io::MeshPromises& promises, const io::VolumeSpace& space,
                                  const audit::AuditOptions& others) {
  audit::AuditOptions options = others;
  options.radius_ratio_floor = promises.quality_floor;
  options.count_junctions = promises.interfaces;
  options.max_distance = promises.max_distance;
  options.layers = promises.smooth ? layers_of(space.spacing) : Index3{1, 1, 1};
  return options;
}

}  // namespace mw::engine
