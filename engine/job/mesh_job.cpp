// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the main job in their order.
#include "engine/job/mesh_job.h"

#include "engine/job/certificate.h"
#include "engine/job/count_pilot.h"
#include "engine/job/unpacking.h"
#include "engine/labels/fingerprint.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/size_image.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/settings/number_text.h"
#include "engine/settings/promises.h"
#include "engine/store/journal/workdir.h"
#include "engine/system/memory.h"
#include "engine/version.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"
#include "io/volume/label_volume.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

/// Calls stop(), which may throw, before each read.
class StoppableVolume : public io::VolumeView {
 public:
  StoppableVolume(const io::LabelVolume& volume, std::function<void()> stop)
      : VolumeView(volume), stop_(std::move(stop)) {}

  void read(const Box3& box, std::span<RawLabel> out) const override {
    stop_();
    below().read(box, out);
  }

 private:
  std::function<void()> stop_;
};

/// By dense label, as OutputOptions has them.
std::vector<double> edge_sizes(const SizeRules& rules, const io::LabelTable& table) {
  std::vector<double> out(rules.any() ? table.size() : 0);
  for (Label label = 0; label < out.size(); ++label) {
    out[label] = rules.of_label(table.raw(label)).value_or(0.0);
  }
  return out;
}

constexpr const char* kCountScale = "count scale";

/// What a run has in common with the one that it goes on from, beside what the engine adds.
std::string identity_of(const report::FinishedRun& run) {
  std::string out =
      io::text("version = ", version(), "\nlabel fingerprint = ", run.fingerprint, "\n");
  if (run.count) out += io::text(kCountScale, " = ", run.count->scale, "\n");
  return out;
}

/// The scale that the run found whose work is gone on with; none: there is no such run.
std::optional<report::CountFacts> saved_count(const MeshJob& job, report::FinishedRun run) {
  if (!job.run.store.resume) return std::nullopt;
  const auto text = saved_value(job.run.store.workdir, kCountScale);
  double scale = 0;
  if (!text || !read_all(*text, scale) || !(scale > 0)) return std::nullopt;
  run.count = {.asked = static_cast<std::uint64_t>(job.settings.sizes.count), .scale = scale};
  const std::string identity =
      identity_of(run) + identity_text(run.volume, with_scale(job.settings, scale));
  if (!is_identity_of(job.run.store.workdir, identity)) return std::nullopt;
  return run.count;
}

/// By a pilot, unless an earlier run has made it.
report::CountFacts count_facts(const PilotTask& task, const report::FinishedRun& run) {
  if (const auto saved = saved_count(task.job, run)) return *saved;
  const report::ResourceMeter meter;
  report::CountFacts out = scale_for_count(task);
  out.seconds = meter.read().wall_seconds;
  return out;
}

/// What the marches are told beside what the job says.
RunHooks run_hooks(const MeshJob& job, const report::FinishedRun& run, std::uint64_t memory) {
  const io::LabelTable& table = run.labels;
  RunHooks out = job.run;
  out.store.memory = memory;
  out.store.identity = identity_of(run);
  out.progress = [&job](const RunProgress& at) {
    job.stop();
    if (job.run.progress) job.run.progress(at);
  };
  out.output = {.wanted = wanted_labels(job.choice, table),
                .measure_quality = job.is_measured,
                .measure_shape = job.is_measured,
                .measure_edges = job.is_measured && job.settings.sizes.rules.any(),
                .edge_sizes = edge_sizes(job.settings.sizes.rules, table)};
  return out;
}

/// ERRORS: as SizeImage; kUsage when there is an image in the settings and not in the job.
std::optional<SizeImage> size_image(const io::VolumeInfo& labels, const MeshJob& job) {
  const std::string& file = job.settings.sizes.rules.image;
  if (file.empty()) return std::nullopt;
  if (job.size_image != nullptr) return SizeImage(*job.size_image, labels, file);
  throw Error(ErrorKind::kUsage, "size: the image " + file + " was not opened");
}

/// What is there to read the volume, the program and the preparation of labels left out.
ReadingRoom reading_room(const MeshJob& job) {
  const Processes* const processes = job.run.processes;
  const int sharers = processes == nullptr ? 1 : processes->count_here();
  const auto shares = static_cast<std::uint64_t>(sharers);
  const std::uint64_t program = program_bytes(0, thread_count(job.run.threads));
  return {.memory = job.run.store.memory == MemoryBudget::kUnlimited
                        ? MemoryBudget::kUnlimited
                        : shares * job.run.store.memory,
          .shares = shares,
          .beside = program + preparation_bytes(job.settings)};
}

/// Says where the work is when a run that ends early leaves some.
RunReport march(const io::DenseVolume& labels, const MeshJob& job, io::MeshSink& sink,
                RunHooks run) {
  std::string work;
  run.store.kept = [&] {
    work = "; the work so far is in " + run.store.workdir.string() + ", add --resume to go on";
    if (job.run.store.kept) job.run.store.kept();
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

report::FinishedRun mesh(const io::LabelVolume& opened, const MeshJob& asked, io::MeshSink& sink) {
  MeshJob job = asked;
  const CertificatePlan plan = plan_certificate(job);
  const report::ResourceMeter meter;
  check(opened.info(), job.settings);
  check_unpacking(opened, reading_room(job));
  std::optional<SizeImage> sizes = size_image(opened.info(), job);
  const StoppableVolume stoppable(opened, job.stop);
  const io::PreparedInput input(stoppable, job.steps,
                                io::SpeckLimits::of_budget(job.run.store.memory));
  return_free_memory_above(0);  // the search for specks has let go of more than is held
  FingerprintVolume volume(input.volume());
  Processes& processes = job.run.processes == nullptr ? one_process() : *job.run.processes;
  report::FinishedRun run{.volume = volume.info(),
                          .labels = processes.collect_labels(volume, job.run.threads),
                          .sizes = job.settings.sizes,
                          .specks = input.specks()};
  run.labels_seconds = meter.read().wall_seconds;
  run.fingerprint = volume.text();
  if (sizes) run.fingerprint += io::text(", sizes ", sizes->fingerprint());
  if (job.labels_known) job.labels_known(run.labels.size());
  const io::DenseVolume labels(input.volume(), run.labels);
  const std::uint64_t memory = job.run.store.memory - input.held_bytes();
  if (asked.settings.sizes.count > 0) {
    run.count = count_facts(
        {.labels = labels, .job = asked, .image = sizes ? &*sizes : nullptr, .memory = memory},
        run);
    job.settings = with_scale(asked.settings, run.count->scale);
    run.sizes = job.settings.sizes;
    if (sizes) sizes.emplace(sizes->scaled(run.count->scale));
    check(opened.info(), job.settings);
  }
  std::optional<Certifier> certifier;
  if (plan.why_not.empty()) certifier.emplace(plan, job, labels, sink, job.stop);
  try {
    RunHooks hooks = run_hooks(job, run, memory);
    hooks.sizes = sizes ? &*sizes : nullptr;
    run.engine = march(labels, job, certifier ? certifier->sink() : sink, std::move(hooks));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kCheckFailed) {
      refuse_changed_input(input.volume(), volume.sum(), job.run.threads);
    }
    throw;
  }
  run.why_no_certificate = plan.why_not;
  run.why_no_volumes = why_no_volumes(promises_of(job.settings));
  if (certifier) run.certificate = certifier->report();
  run.resources = meter.read();
  return run;
}

}  // namespace mw::engine
