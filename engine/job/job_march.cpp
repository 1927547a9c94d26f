// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/job_march.h"

#include "engine/job/job_count.h"
#include "engine/store/journal/identity.h"
#include "engine/version.h"
#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

/// Says how to go on after an error of usage that was found once work had been saved: what is
/// written was refused, and the same command would be refused again.
std::string way_after_refusal(const RunHooks& hooks) {
  if (!hooks.keep.folder.empty()) return way_on(hooks);
  const std::string folder = hooks.store.workdir.string();
  return "the work so far is in " + folder +
         "; change what is written (format, --parts) and add --workdir " + folder +
         " and --resume, or delete that folder to mesh with other settings";
}

}  // namespace

RunHooks run_hooks(const MeshJob& job, const report::FinishedRun& run, std::uint64_t memory) {
  const io::LabelTable& table = run.labels;
  RunHooks out = job.run;
  out.store.memory = memory;
  out.store.identity = identity_of(run);
  // What did not change is known by its place in the box that is meshed.
  out.keep.identity += io::text("version = ", version(), "\n", first_voxel_text(run.volume));
  out.progress = [&job](const RunProgress& at) {
    job.stop();
    if (job.run.progress) job.run.progress(at);
  };
  out.output = {.wanted = wanted_labels(job.choice, table)};
  return out;
}

RunReport march(const io::DenseVolume& labels, const MeshJob& job, io::MeshSink& sink,
                RunHooks run) {
  bool is_kept = false;
  run.store.kept = [&] {
    is_kept = true;
    if (job.run.store.kept) job.run.store.kept();
  };
  try {
    return mesh_volume(labels, job.settings, sink, run);
  } catch (const Error& error) {
    if (!is_kept) throw;
    const bool is_refused = error.kind() == ErrorKind::kUsage;
    throw Error(error.kind(), error.what() + ("; " + (is_refused ? way_after_refusal(job.run)
                                                                 : way_on(job.run))));
  }
}

}  // namespace mw::engine
