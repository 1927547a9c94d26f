// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/job_finish.h"

#include "engine/job/job_sizes.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/system/crew.h"

namespace mw::engine {

FinishTask finish_task(const MeshJob& job, const report::FinishedRun& run) {
  const std::size_t sort_bytes = ConnectTask::memory_of(job.run.store.memory);
  const int threads = thread_count(job.run.threads);
  FinishTask out{.connect = {.options = job.connect,
                             .memory_bytes = sort_bytes,
                             .work_bytes = ConnectTask::work_of(job.run.store.memory, threads),
                             .threads = threads},
                 .finds_parts = job.finds_parts,
                 .leaves_values_out = job.leaves_values_out,
                 .is_curved = job.is_curved,
                 .between = job.stop};
  out.connect.options.watched = sized_interfaces(job, run.labels);
  if (run.sizes.rules.any()) {
    out.edges.emplace(
        EdgesTask{.table = run.labels, .sizes = edge_sizes(run.sizes.rules, run.labels)});
  }
  if (job.finds_volumes) {
    const io::VolumeSpace& space = run.volume.space;
    out.volumes.emplace(
        VolumesTask{.table = run.labels,
                    .space = space,
                    .layers = layers_of(space.spacing, run.volume.shape, job.settings.periodic)});
  }
  if (job.is_measured || job.finds_quality) {
    out.figures.emplace(FiguresTask{.has_shape = job.is_measured, .sort_bytes = sort_bytes});
  }
  return out;
}

}  // namespace mw::engine
