// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the main job in their order.
#include "engine/job/mesh_job.h"

#include "engine/job/certificate.h"
#include "engine/job/shared_scan.h"
#include "engine/job/stoppable_volume.h"
#include "engine/labels/fingerprint.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/system/resident_memory.h"
#include "engine/version.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

StoreOptions store_options(const MeshJob& job, const std::string& fingerprint,
                           std::uint64_t memory) {
  return {.memory = memory,
          .workdir = job.workdir,
          .resume = job.resume,
          .identity =
              std::string("version = ") + version() + "\nlabel fingerprint = " + fingerprint + "\n",
          .group = {.age = job.save_every}};
}

RunHooks run_hooks(const MeshJob& job, const io::LabelTable& table, const JobHooks& hooks) {
  RunHooks out{.threads = job.threads, .trace = hooks.trace};
  out.progress = [&hooks](const RunProgress& at) {
    hooks.stop();
    if (hooks.progress) hooks.progress(at);
  };
  out.output = {.wanted = wanted_labels(job.choice, table),
                .measure_quality = job.is_measured,
                .measure_shape = job.is_measured,
                .measure_edges = job.is_measured && !job.settings.sizes.labels.empty()};
  out.owns_process = job.owns_process;
  out.team = job.team;
  out.together = job.together;
  out.stop_after_epoch = hooks.stop_after_epoch;
  return out;
}

/// Says where the work is when a run that ends early leaves some.
RunReport march(const io::DenseVolume& labels, const MeshJob& job, io::MeshSink& sink, RunHooks run,
                const JobHooks& hooks) {
  std::string work;
  run.store.kept = [&] {
    work = "; the work so far is in " + job.workdir.string() + ", add --resume to go on";
    if (hooks.kept) hooks.kept();
  };
  try {
    return mesh_volume(labels, job.settings, sink, run);
  } catch (const Error& error) {
    if (work.empty()) throw;
    throw Error(error.kind(), error.what() + work);
  }
}

/// Tells of a mesh that does not pass its check because the labels are no longer those that were
/// read first.
void refuse_changed_input(const io::LabelVolume& volume, std::uint64_t first, int threads) {
  const FingerprintVolume again(volume);
  static_cast<void>(collect_labels(again, threads));
  if (again.sum() != first) io::fail_input_changed();
}

}  // namespace

report::FinishedRun mesh(const io::LabelVolume& opened, const MeshJob& job, io::MeshSink& sink,
                         const JobHooks& hooks) {
  const CertificatePlan plan = plan_certificate(job);
  const report::ResourceMeter meter;
  check(opened.info(), job.settings);
  const StoppableVolume stoppable(opened, hooks.stop);
  const io::PreparedInput input(stoppable, job.steps, io::SpeckLimits::of_budget(job.memory));
  return_free_memory_above(0);  // the search for specks has let go of more than is held
  FingerprintVolume volume(input.volume());
  report::FinishedRun run{.volume = volume.info(),
                          .labels = job.team == nullptr
                                        ? collect_labels(volume, job.threads)
                                        : collect_together(*job.team, volume, job.threads),
                          .sizes = job.settings.sizes,
                          .specks = input.specks()};
  run.labels_seconds = meter.read().wall_seconds;
  run.fingerprint = volume.text();
  if (hooks.labels_known) hooks.labels_known(run.labels.size());
  const io::DenseVolume labels(input.volume(), run.labels);
  RunHooks marches = run_hooks(job, run.labels, hooks);
  marches.store = store_options(job, run.fingerprint, job.memory - input.held_bytes());
  std::optional<Certifier> certifier;
  if (plan.why_not.empty()) certifier.emplace(plan, job, labels, sink, hooks.stop);
  try {
    run.engine = march(labels, job, certifier ? certifier->sink() : sink, marches, hooks);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kCheckFailed) {
      refuse_changed_input(input.volume(), volume.sum(), job.threads);
    }
    throw;
  }
  run.why_no_certificate = plan.why_not;
  if (certifier) run.certificate = certifier->report();
  run.resources = meter.read();
  return run;
}

}  // namespace mw::engine
