// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the main job in their order.
#include "engine/job/mesh_job.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/finish/passes.h"
#include "engine/job/certificate_plan.h"
#include "engine/job/count_pilot.h"
#include "engine/job/earlier_run.h"
#include "engine/job/halving.h"
#include "engine/job/kept_input.h"
#include "engine/keep/keep_options.h"
#include "engine/labels/label_counts.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "engine/labels/score_crossings.h"
#include "engine/labels/size_image.h"
#include "engine/labels/texture_volume.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/settings/number_text.h"
#include "engine/settings/promises.h"
#include "engine/settings/together.h"
#include "engine/store/journal/identity.h"
#include "engine/system/crew.h"
#include "engine/system/memory.h"
#include "engine/verify/verify_mesh.h"
#include "engine/version.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"
#include "io/remote/wait_stop.h"
#include "io/volume/decode.h"
#include "io/volume/label_volume.h"
#include "io/volume/volume_readers.h"
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

/// A volume that lies elsewhere.
class PlacedVolume : public io::VolumeView {
 public:
  PlacedVolume(const io::LabelVolume& volume, const io::VolumeSpace& space)
      : VolumeView(volume), info_(volume.info()) {
    info_.space = space;
  }

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override { below().read(box, out); }

 private:
  io::VolumeInfo info_;
};

/// Returns sizes by dense label, as EdgesTask has them.
std::vector<double> edge_sizes(const SizeRules& rules, const io::LabelTable& table) {
  std::vector<double> out(table.size());
  for (Label label = 0; label < out.size(); ++label) {
    out[label] = rules.of_label(table.raw(label)).value_or(0.0);
  }
  return out;
}

/// What sorts for parts and digest may take of the memory, and what a certificate may.
constexpr double kSortsShare = 3.0 / 64;
constexpr double kCertificateShare = 0.25;

constexpr const char* kCountScale = "count scale";

/// Returns what a run shares with the one that it goes on from, beside what the engine adds.
std::string identity_of(const report::FinishedRun& run) {
  std::string out = io::text("version = ", version(), "\nresults = ", results_id(),
                             "\nlabel fingerprint = ", run.fingerprint, "\n");
  if (run.count) out += io::text(kCountScale, " = ", run.count->scale, "\n");
  return out;
}

/// Returns the scale that the run found whose work this one goes on with, if there is such a run.
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

/// Returns how many of the labels that are written have no size, which the scale does not reach.
std::uint64_t labels_without_size(const MeshJob& job, const io::LabelTable& table) {
  const SizeRules& rules = job.settings.sizes.rules;
  if (!rules.any() || !rules.image.empty()) return 0;
  const LabelSelection kept(wanted_labels(job.choice, table), table);
  std::uint64_t out = 0;
  for (Label label = 0; label < table.size(); ++label) {
    out += kept.keeps(label) && !rules.of_label(table.raw(label)) ? 1U : 0U;
  }
  return out;
}

/// Finds the scale by a pilot, unless an earlier run has done so.
report::CountFacts count_facts(const PilotTask& task, const report::FinishedRun& run) {
  const engine::ResourceMeter meter;
  const std::optional<report::CountFacts> saved = saved_count(task.job, run);
  report::CountFacts out = saved ? *saved : scale_for_count(task);
  if (!saved) out.seconds = meter.read().wall_seconds;
  out.labels_without_size = labels_without_size(task.job, run.labels);
  return out;
}

/// Returns what the marches are told, beyond what the job says.
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

/// Opens the image of sizes, if any.  ERRORS: those of SizeImage; kUsage when the job lacks it.
std::optional<SizeImage> size_image(const io::VolumeInfo& labels, const MeshJob& job) {
  const std::string& file = job.settings.sizes.rules.image;
  if (file.empty()) return std::nullopt;
  if (job.size_image != nullptr) return SizeImage(*job.size_image, labels, file);
  io::fail_usage("size: the image " + file + " was not opened");
}

/// Returns the smallest size of an image.  ERRORS: mw::Error(kInput) if it asks for none.
double least_size_of(const SizeImage& image, const MeshJob& job) {
  const double least = image.least();
  if (std::isfinite(least)) return least;
  io::fail_input(job.settings.sizes.rules.image, {}, "has no positive number, so no size is asked",
                 "give edge lengths where they matter, and 0 elsewhere");
}

/// Returns how many voxels of an image, whose smallest size is `smallest`, ask for less than can be
/// had.
report::RaisedSizes raised_sizes(const SizeImage& image, double smallest,
                                 const io::VolumeInfo& labels, int halvings) {
  const double least = std::ldexp(least_size(labels), -halvings);
  if (smallest >= least) return {};
  return {.voxels = image.voxels_below(least), .least = told_size(least)};
}

/// Returns the room to read the volume, beside the program and the preparation of labels.
io::ReadingRoom reading_room(const MeshJob& job, bool has_scores = false) {
  const Processes* const processes = job.run.processes;
  const int sharers = processes == nullptr ? 1 : processes->count_here();
  const auto shares = static_cast<std::uint64_t>(sharers);
  const std::uint64_t program = program_bytes(0, thread_count(job.run.threads));
  return {.memory = job.run.store.memory == MemoryBudget::kUnlimited
                        ? MemoryBudget::kUnlimited
                        : shares * job.run.store.memory,
          .shares = shares,
          .beside = program + preparation_bytes(job.settings, has_scores)};
}

/// Says how to go on after an error of usage that was found once work had been saved: what is
/// written was refused, and the same command would be refused again.
std::string way_after_refusal(const RunHooks& hooks) {
  if (!hooks.keep.folder.empty()) return way_on(hooks);
  const std::string folder = hooks.store.workdir.string();
  return "the work so far is in " + folder +
         "; change what is written (format, --parts) and add --workdir " + folder +
         " and --resume, or delete that folder to mesh with other settings";
}

/// Marches, and says where the work is when a run that ends early leaves some.
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

void warn(const MeshJob& job, const std::string& line) {
  if (job.warn && !line.empty()) job.warn(line);
}

/// Returns all labels, and warns if some were rounded.  ERRORS: mw::Error(kUsage) for an image.
io::LabelTable first_pass(FingerprintVolume& volume, const TextureVolume& texture,
                          const MeshJob& job) {
  Processes& processes = job.run.processes == nullptr ? one_process() : *job.run.processes;
  const std::uint64_t before = io::rounded_voxels();
  io::LabelTable out = processes.collect_labels(
      volume, scanner_count(volume, job.run.threads, job.run.store.memory));
  if (io::rounded_voxels() > before) {
    warn(job,
         io::text("labels: numbers within ", io::kRounding, " of whole ones are rounded to them"));
  }
  if (job.takes_images || !texture.is_image(out)) return out;
  io::fail_usage("the labels look like the grey values of an image: there are ", out.size(),
                 ", and most voxels differ a little from both neighbours; segment it first, or "
                 "--force meshes it");
}

/// Throws if the labels are not those that were read first, which explains a mesh that does not
/// pass its check.
void refuse_changed_input(const io::LabelVolume& volume, std::uint64_t first, int threads) {
  const FingerprintVolume again(volume);
  static_cast<void>(collect_labels(again, threads));
  if (again.sum() != first) io::fail_input_changed();
}

/// The image of sizes as the marches take it, and what follows from it.
struct JobSizes {
  std::optional<SizeImage> image;
  int halvings = 0;  ///< how often tets are cut behind the marches
  report::RaisedSizes raised;
};

/// Settles sizes, and gives the job the settings of the marches.
JobSizes settle_sizes(const io::VolumeInfo& opened, const MeshJob& asked, MeshJob& job) {
  // An image has the slices of the file, and the lattice those between them, too.
  JobSizes out{.image = size_image(opened, asked)};
  const io::VolumeInfo volume = io::info_after(asked.steps, opened);
  const double smallest =
      out.image ? least_size_of(*out.image, asked) : std::numeric_limits<double>::infinity();
  out.halvings = halvings_of(volume, asked, smallest);
  job.settings = before_halvings(asked.settings, out.halvings);
  if (!out.image) return out;
  if (asked.settings.sizes.count == 0) {
    out.raised = raised_sizes(*out.image, smallest, volume, out.halvings);
  }
  out.image.emplace(out.image->scaled(std::ldexp(1.0, out.halvings)));
  return out;
}

/// Checks before any label is read that the job can be done.
void check_job(const io::LabelVolume& opened, const MeshJob& job) {
  const io::VolumeInfo volume = io::info_after(job.steps, opened.info());
  check(volume, job.settings);
  const bool has_scores = opened.scores() != nullptr;
  Asked asked = asked_of(job.run, job.settings);
  asked.scores = has_scores;
  asked.merge = !job.steps.merge.empty();
  asked.interpolate = job.steps.interpolate;
  asked.weld = !job.steps.weld.empty();
  check_together(asked);
  check_object_box(volume, job);
  warn(job, many_layers_text(opened.info()));
  io::check_unpacking(opened, reading_room(job, has_scores));
  for (const SampleImage& sample : job.samples) {
    io::check_unpacking(*sample.image, reading_room(job));
  }
}

/// Returns what a thread takes that reads the volume after the steps.
std::uint64_t bytes_to_read(const io::LabelVolume& opened, const io::InputSteps& steps) {
  return reader_bytes(opened) + (steps.interpolate ? io::InterpolatedVolume::kReadBytes : 0);
}

/// Settles sizes and settings, and checks that the job can be done.
JobSizes settle(const io::LabelVolume& opened, const MeshJob& asked, MeshJob& job) {
  JobSizes out = settle_sizes(opened.info(), asked, job);
  check_job(opened, job);
  return out;
}

/// Returns the job with sizes in physical units.
MeshJob with_physical_sizes(const io::LabelVolume& opened, MeshJob job) {
  SizeRules& rules = job.settings.sizes.rules;
  rules = rules.in_physical_units(voxel_edge(io::info_after(job.steps, opened.info())));
  return job;
}

/// One job: labels behind the views that it asks for, marches into a finished mesh, passes over
/// it, and what is told of all that.
class MeshRun {
 public:
  MeshRun(const io::LabelVolume& opened, const MeshJob& asked)
      : opened_(opened),
        asked_(asked),
        job_(asked),
        plan_(plan_certificate(job_, bytes_to_read(opened, asked.steps))),
        sizes_(settle(opened, asked, job_)),
        from_file_(opened, job_.stop),
        kept_(from_file_, job_),
        limits_(io::SpeckLimits::of_budget(job_.run.store.memory)),
        shared_(kept_.volume(), job_.run.store.memory - limits_.memory),
        input_(shared_, job_.steps, limits_),
        texture_(input_.volume()),
        volume_(texture_) {
    shared_.end();
    return_free_memory_above(0);  // the search for specks has let go of more than is held
  }

  report::FinishedRun go(std::span<io::MeshSink* const> sinks) {
    read_labels();
    const io::DenseVolume labels(input_.volume(), run_.labels);
    if (asked_.settings.sizes.count > 0) find_count(labels);
    check_interfaces(job_.connect, run_.labels);
    plan_check(labels);
    const FinishTask task = finish_task(labels);
    io::ScratchMesh mesh(job_.folder.empty() ? "." : job_.folder);
    std::optional<FinishFacts> facts;
    const auto finish = [&] { facts = apply_passes(mesh, task, sinks); };
    io::ScratchMeshSink sink(mesh, finish, bytes_to_finish(task, sinks));
    march_into(sink, labels);
    if (facts) run_.take(*facts);
    leave_for_later();
    tell();
    return std::move(run_);
  }

 private:
  void read_labels() {
    run_.volume = volume_.info();
    run_.labels = first_pass(volume_, texture_, job_);
    run_.sizes = asked_.settings.sizes;
    run_.labels_seconds = meter_.read().wall_seconds;
    run_.fingerprint = volume_.text();
    if (sizes_.image) run_.fingerprint += io::text(", sizes ", sizes_.image->fingerprint());
    if (const io::LabelScores* const scores = opened_.scores()) {
      run_.fingerprint += io::text(", scores ", fingerprint(*scores));
    }
    leave_out_zero();
    if (job_.labels_known) job_.labels_known(run_.labels.size());
    job_.run.store.memory_beside = std::min(input_.held_bytes(), job_.run.store.memory);
  }

  /// Leaves out label 0 where nobody said what is written, and the names that it is nothing.  Of
  /// probabilities and distances it is what none of the names has, and stays.
  void leave_out_zero() {
    const bool is_open = !job_.choice.any() && opened_.scores() == nullptr;
    if (is_open && is_zero_nothing(run_.labels, run_.volume.names)) {
      job_.choice.background = asked_.choice.background = 0;
      run_.leaves_out_zero = true;
    }
    run_.choice = job_.choice;
  }

  /// Returns the memory of the marches.
  [[nodiscard]] std::uint64_t memory() const {
    return job_.run.store.memory - job_.run.store.memory_beside;
  }

  void find_count(const io::DenseVolume& labels) {
    run_.count = count_facts({.labels = labels,
                              .job = asked_,
                              .image = sizes_.image ? &*sizes_.image : nullptr,
                              .memory = memory(),
                              .memory_beside = job_.run.store.memory_beside},
                             run_);
    job_.settings = with_scale(asked_.settings, run_.count->scale);
    run_.sizes = job_.settings.sizes;
    if (sizes_.image) sizes_.image.emplace(sizes_.image->scaled(run_.count->scale));
    check(input_.volume().info(), job_.settings);
  }

  void plan_check(const io::DenseVolume& labels) {
    const std::uint64_t standing = standing_bytes(labels, job_.settings, job_.run);
    const std::uint64_t others =
        job_.run.store.memory_beside + standing + io::ScratchMesh::kBufferBytes;
    plan_ = beside_others(plan_, job_, others);
    job_.run.store.buffers_grow = kSortsShare + (plan_.why_not.empty() ? kCertificateShare : 0);
  }

  [[nodiscard]] io::MeshPromises promises() const {
    io::MeshPromises out = promises_of(asked_.settings);
    out.halvings = sizes_.halvings;
    return out;
  }

  [[nodiscard]] FinishTask finish_task(const io::DenseVolume& labels) {
    FinishTask out = looking_task(job_, run_);
    out.leaves_values_out = job_.leaves_values_out;
    out.cut = cut_task(sizes_.halvings, asked_, labels.info());
    out.connect.options = job_.connect;
    out.connect.options.watched = sized_interfaces(job_, run_.labels);
    if (plan_.why_not.empty()) {
      out.certificate.emplace(certificate_task(plan_, job_, labels, promises()));
    }
    if (job_.samples.empty()) return out;
    sampler_.emplace(job_.samples, opened_.info(), thread_count(job_.run.threads));
    out.samples = &*sampler_;
    return out;
  }

  void march_into(io::MeshSink& sink, const io::DenseVolume& labels) {
    RunHooks hooks = run_hooks(job_, run_, memory());
    hooks.sizes = sizes_.image ? &*sizes_.image : nullptr;
    hooks.keep.opened = kept_.folder();
    hooks.keep.begin = [this] { kept_.begin(); };
    try {
      run_.engine = march(labels, job_, sink, std::move(hooks));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kCheckFailed) {
        refuse_changed_input(input_.volume(), volume_.sum(), job_.run.threads);
      }
      throw;
    }
    run_.engine.halvings = sizes_.halvings;
  }

  /// Tells what an edit changed, and keeps the labels for the next one.
  void leave_for_later() {
    const MeshSize size{run_.engine.vertices, run_.engine.tets};
    if (job_.delivered) job_.delivered();
    if (job_.delta != Delta::kNo && kept_.knows_delta()) {
      run_.delta = kept_.delta(input_.volume(), job_, size);
      if (job_.tell) job_.tell(*run_.delta);
    }
    kept_.finish(job_.steps, size);
    if (run_.engine.keep) run_.engine.keep->voxels_read = kept_.voxels_read();
  }

  void tell() {
    run_.settings = asked_.settings;
    run_.has_scores = opened_.scores() != nullptr;
    run_.raised = sizes_.raised;
    run_.specks = input_.specks();
    run_.slices = input_.slices();
    run_.welds = input_.welds();
    if (sampler_) run_.samples = sampler_->facts();
    run_.radius_ratio_floor = floor_of(promises());
    run_.why_no_certificate = plan_.why_not;
    run_.why_no_volumes =
        opened_.scores() != nullptr ? kVolumesOfScores : why_no_volumes(promises());
    run_.resources = meter_.read();
  }

  const engine::ResourceMeter meter_;
  const io::LabelVolume& opened_;
  MeshJob asked_;
  MeshJob job_;  ///< with the settings of the marches
  CertificatePlan plan_;
  JobSizes sizes_;
  StoppableVolume from_file_;
  KeptInput kept_;
  io::SpeckLimits limits_;
  SharedReads shared_;
  io::PreparedInput input_;
  TextureVolume texture_;
  FingerprintVolume volume_;
  std::optional<ImageSampler> sampler_;
  report::FinishedRun run_;
};

}  // namespace

std::vector<LabelPair> sized_interfaces(const MeshJob& job, const io::LabelTable& table) {
  std::vector<LabelPair> out;
  const LabelSelection kept(wanted_labels(job.choice, table), table);
  // A label that the volume does not have is refused by the marches.
  const auto is_written = [&](RawLabel label) {
    return table.contains(label) && kept.keeps(table.dense(label));
  };
  for (const InterfaceSize& s : job.settings.sizes.rules.interfaces) {
    const bool is_pair = s.low && s.high;
    if (is_pair && is_written(*s.low) && is_written(*s.high)) out.emplace_back(*s.low, *s.high);
  }
  return out;
}

FinishTask looking_task(const MeshJob& job, const report::FinishedRun& run) {
  const std::size_t sort_bytes = ConnectTask::memory_of(job.run.store.memory);
  const int threads = thread_count(job.run.threads);
  FinishTask out{.connect = {.options = {.watched = sized_interfaces(job, run.labels)},
                             .memory_bytes = sort_bytes,
                             .work_bytes = ConnectTask::work_of(job.run.store.memory, threads),
                             .threads = threads},
                 .finds_parts = job.finds_parts,
                 .between = job.stop};
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

report::FinishedRun mesh(const io::LabelVolume& opened, const MeshJob& job,
                         std::span<io::MeshSink* const> sinks) {
  const io::WaitStop waits(&job.stop);
  const KeepOptions& keep = job.run.keep;
  try {
    if (keep.use != KeepUse::kUpdate) {
      return MeshRun(opened, with_physical_sizes(opened, job)).go(sinks);
    }
    const PlacedVolume placed(opened, settled_space(keep.folder, opened.info().space));
    return MeshRun(placed, with_physical_sizes(placed, job)).go(sinks);
  } catch (const DamagedWork& damage) {
    fail_damaged(damage, job.run);
  }
}

}  // namespace mw::engine
