// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the main job in their order.
#include "engine/job/mesh_job.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>

#include "engine/finish/passes.h"
#include "engine/job/certificate_plan.h"
#include "engine/job/count_pilot.h"
#include "engine/job/earlier_run.h"
#include "engine/job/halving.h"
#include "engine/job/volume_delta.h"
#include "engine/keep/keep_folder.h"
#include "engine/keep/keep_options.h"
#include "engine/keep/kept_labels.h"
#include "engine/labels/label_counts.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "engine/labels/score_crossings.h"
#include "engine/labels/size_image.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/settings/number_text.h"
#include "engine/settings/promises.h"
#include "engine/store/journal/workdir.h"
#include "engine/system/memory.h"
#include "engine/verify/verify_mesh.h"
#include "engine/version.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"
#include "io/remote/wait_stop.h"
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

/// Counts voxels that are read.
class CountedVolume : public io::VolumeView {
 public:
  using VolumeView::VolumeView;
  void read(const Box3& box, std::span<RawLabel> out) const override {
    below().read(box, out);
    voxels_ += static_cast<std::uint64_t>(box.voxels());
  }
  [[nodiscard]] std::uint64_t voxels() const { return voxels_; }

 private:
  mutable std::atomic<std::uint64_t> voxels_ = 0;
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

/// Throws if a box has no voxel: what it was to say is not known then.  One that lies outside of
/// the volume says that nothing has changed in it, as where the volume was cropped.
void check_changed(const std::vector<Box3>& changed) {
  for (const Box3& box : changed) {
    if (!is_empty(box)) continue;
    io::fail_usage("--changed: the box from ", box.lo.x, ",", box.lo.y, ",", box.lo.z, " to ",
                   box.hi.x, ",", box.hi.y, ",", box.hi.z,
                   " has no voxel: give the first voxel, and the one behind the last");
  }
}

/// The labels of a run that keeps something, and those that it leaves for the next one.  With
/// several processes the one that speaks leaves them.
class KeptInput {
 public:
  /// ERRORS: those of KeepFolder and KeptLabels; mw::Error(kUsage) when the labels before are those
  /// of a volume of another shape, and for Delta::kOn when no run before was complete.
  KeptInput(const io::LabelVolume& opened, const MeshJob& job)
      : counted_(opened), memory_(job.run.store.memory) {
    const KeepOptions& options = job.run.keep;
    const bool speaks = job.run.processes == nullptr || job.run.processes->speaks();
    if (options.folder.empty() || !speaks) return;
    check_changed(options.changed);
    folder_ = std::make_shared<KeepFolder>(options.folder, options.use);
    open_before(job);
    changed_ = {{{0, 0, 0}, opened.info().shape}};
    const bool reads_all = job.certify == Certify::kOn;  // it vouches for the whole input
    const bool is_patched = before_ && !options.changed.empty() && !reads_all && !is_renumbered_;
    if (!is_patched) return;
    changed_ = options.changed;
    patched_.emplace(counted_, *before_, folder_->with_incomplete(changed_));
  }

  /// Must be called before the run keeps anything: from here on its labels may be in the folder.
  void begin() {
    if (folder_ == nullptr) return;
    if (patched_) refuse_untold_change();
    folder_->begin_change(changed_);
    after_ = std::make_unique<io::AtomicFile>(folder_->path() / kLabelsFile);
    write_kept_labels(volume(), *after_, scanner_count(volume(), 1, memory_));
    folder_->expect_labels(after_->appended());
  }

  [[nodiscard]] const io::LabelVolume& volume() const {
    return patched_ ? static_cast<const io::LabelVolume&>(*patched_) : counted_;
  }
  [[nodiscard]] const std::shared_ptr<KeepFolder>& folder() const { return folder_; }
  [[nodiscard]] std::uint64_t voxels_read() const { return counted_.voxels(); }

  /// Tells whether there is a run to compare with.
  [[nodiscard]] bool knows_delta() const { return before_.has_value(); }

  /// Returns what the edit did to the volume and to the mesh.  `after` is what the steps of the job
  /// made of the labels; before, the steps of the run that was complete last did so.
  /// REQUIRES: knows_delta().
  [[nodiscard]] io::Json delta(const io::LabelVolume& after, const MeshJob& job,
                               const MeshSize& size) const {
    const PatchedVolume unpatched(counted_, *before_, {});
    const io::PreparedInput before(unpatched, note_.steps,
                                   io::SpeckLimits::of_budget(job.run.store.memory));
    VerifyTask task{.options = {},
                    .threads = thread_count(job.run.threads),
                    .folder = folder_->path(),
                    .between = job.stop};
    task.memory_bytes = std::min(task.memory_bytes, job.run.store.memory / 8);
    const ReaderRoom room{.each = kComparerBytes, .memory = job.run.store.memory};
    const int readers = reader_count(after, 1, room);
    task.readers = readers_of_thread(task.threads, reader_bytes(after), task.memory_bytes);
    VolumeDelta delta = delta_of(before.volume(), after, task, readers);
    delta.is_renumbered = is_renumbered_;
    return delta_json(delta, note_.size, size);
  }

  /// Must be called once the run is complete.
  void finish(const io::InputSteps& steps, const MeshSize& size) {
    if (folder_ == nullptr) return;
    const std::uint64_t numbering = counted_.info().numbering;
    append_note(*after_, io::text(size.vertices, " ", size.tets, " ", numbering, " ",
                                  folder_->number(), "\n") +
                             text_of(steps));
    after_->commit();
    folder_->end_change();
  }

 private:
  /// What finish() says of a run beside its labels.
  struct Note {
    std::optional<MeshSize> size;
    std::uint64_t numbering = 0;
    std::uint64_t folder = 0;  ///< KeepFolder::number()
    io::InputSteps steps;
  };

  static Note parse_note(const std::string& note) {
    Note out;
    MeshSize size;
    std::istringstream text(note);
    if (text >> size.vertices >> size.tets >> out.numbering >> out.folder) out.size = size;
    std::string rest;
    std::getline(text, rest);  // the end of the first line
    std::getline(text, rest, '\0');
    out.steps = steps_of(text ? rest : std::string());
    return out;
  }

  void open_before(const MeshJob& job) {
    const KeepOptions& options = job.run.keep;
    if (options.changed.empty() && job.delta == Delta::kNo) return;
    const std::filesystem::path file = folder_->path() / kLabelsFile;
    const std::string folder = folder_->path().string();
    before_ = KeptLabels::open(file, counted_.info().shape);
    if (before_) {
      note_ = parse_note(before_->note());
      if (note_.folder != folder_->number()) {
        throw DamagedWork(kLabelsFile, "it is of another folder");
      }
      is_renumbered_ = note_.numbering != counted_.info().numbering;
      if (options.say && is_renumbered_ && !options.changed.empty()) {
        options.say(folder +
                    ": labels have other numbers than in the last run here, since these depend on "
                    "all masks; all labels are read, not only --changed");
      }
      return;
    }
    if (std::error_code ignored; std::filesystem::exists(file, ignored)) {
      io::fail_usage(folder +
                     ": was kept of a volume of another shape; give that volume, edited, or "
                     "delete the folder and begin it by --keep");
    }
    if (job.delta == Delta::kOn) {
      io::fail_usage("--delta: no run was complete in " + folder + ", there is nothing before");
    }
    if (options.say && !options.changed.empty()) {
      options.say(folder +
                  ": no run was complete here, so all labels are read, not only --changed");
    }
  }

  /// ERRORS: mw::Error(kUsage) when labels outside of the boxes are found to have changed.
  void refuse_untold_change() const {
    const auto box = patched_->untold_change(scanner_count(counted_, 1, memory_));
    if (!box) return;
    const Index3 lo = box->lo + counted_.info().first, hi = box->hi + counted_.info().first;
    io::fail_usage(
        "--changed: labels have changed outside of its boxes, too: those of the tile from ", lo.x,
        ",", lo.y, ",", lo.z, " to ", hi.x, ",", hi.y, ",", hi.z,
        " are not those of the last run in ", folder_->path().string(),
        "; give all boxes that changed, or leave --changed out, so that all is read");
  }

  CountedVolume counted_;
  std::uint64_t memory_;  ///< bytes of the budget
  std::shared_ptr<KeepFolder> folder_;
  std::optional<KeptLabels> before_;
  Note note_;                   ///< of the run before
  bool is_renumbered_ = false;  ///< one number stood for something else before
  std::vector<Box3> changed_;
  std::optional<PatchedVolume> patched_;
  std::unique_ptr<io::AtomicFile> after_;
};

/// Returns sizes by dense label, as FiguresTask has them.
std::vector<double> edge_sizes(const SizeRules& rules, const io::LabelTable& table) {
  std::vector<double> out(rules.any() ? table.size() : 0);
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

/// ERRORS: mw::Error(kUsage) for what does not go with labels that come from scores.
void check_scored(const MeshJob& job) {
  if (!job.steps.merge.empty()) {
    io::fail_usage(
        "--merge: merged labels have no probabilities or distances; merge these (the sum of "
        "probabilities, the least distance) before they are meshed");
  }
  if (!job.steps.weld.empty()) {
    io::fail_usage(
        "--weld: voxels that it fills have no probabilities or distances; mesh a volume of "
        "labels, or without it");
  }
  if (!job.run.keep.folder.empty()) {
    io::fail_usage(
        "--keep: what is kept is known by its labels alone, and interfaces depend on "
        "probabilities and distances, too; mesh without it, or a volume of labels");
  }
  if (job.run.processes != nullptr && job.run.processes->count() > 1) {
    io::fail_usage(
        "--values: probabilities and distances are meshed in one process only, run mwmesh "
        "without mpirun");
  }
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

/// Throws if the labels are not those that were read first, which explains a mesh that does not
/// pass its check.
void refuse_changed_input(const io::LabelVolume& volume, std::uint64_t first, int threads) {
  const FingerprintVolume again(volume);
  static_cast<void>(collect_labels(again, threads));
  if (again.sum() != first) io::fail_input_changed();
}

}  // namespace

std::vector<LabelPair> sized_interfaces(const MeshJob& job, const io::LabelTable& table) {
  std::vector<LabelPair> out;
  const LabelSelection kept(wanted_labels(job.choice, table), table);
  // A label that the volume does not have is refused by the marches.
  const auto is_written = [&](RawLabel label) {
    return table.contains(label) && kept.keeps(table.dense(label));
  };
  for (const InterfaceSize& s : job.settings.sizes.rules.interfaces) {
    if (is_written(s.low) && is_written(s.high)) out.emplace_back(s.low, s.high);
  }
  return out;
}

FinishTask looking_task(const MeshJob& job, const report::FinishedRun& run) {
  const std::size_t sort_bytes = ConnectTask::memory_of(job.run.store.memory);
  FinishTask out{.connect = {.options = {.watched = sized_interfaces(job, run.labels)},
                             .memory_bytes = sort_bytes},
                 .finds_parts = job.finds_parts,
                 .between = job.stop};
  if (!job.is_measured) return out;
  const io::VolumeSpace& space = run.volume.space;
  out.figures.emplace(FiguresTask{.table = run.labels,
                                  .space = space,
                                  .layers = layers_of(space.spacing),
                                  .edge_sizes = edge_sizes(run.sizes.rules, run.labels),
                                  .sort_bytes = sort_bytes});
  return out;
}

namespace {

/// Returns what the run promises, whose tets are cut that often.
io::MeshPromises promises_of(const MeshSettings& asked, int halvings) {
  io::MeshPromises out = promises_of(asked);
  out.halvings = halvings;
  return out;
}

report::FinishedRun mesh_and_keep(const io::LabelVolume& opened, const MeshJob& asked,
                                  std::span<io::MeshSink* const> sinks) {
  MeshJob job = asked;
  CertificatePlan plan = plan_certificate(job, reader_bytes(opened));
  const engine::ResourceMeter meter;
  std::optional<SizeImage> sizes = size_image(opened.info(), job);
  const double smallest =
      sizes ? least_size_of(*sizes, job) : std::numeric_limits<double>::infinity();
  const int halvings = halvings_of(opened.info(), asked, smallest);
  job.settings = before_halvings(asked.settings, halvings);
  check(opened.info(), job.settings);
  check_keep(job.run, job.settings);
  check_object_box(opened.info(), job);
  const io::LabelScores* const scores = opened.scores();
  if (scores != nullptr) check_scored(job);
  io::check_unpacking(opened, reading_room(job, scores != nullptr));
  for (const SampleImage& sample : job.samples)
    io::check_unpacking(*sample.image, reading_room(job));
  report::RaisedSizes raised;
  if (sizes && asked.settings.sizes.count == 0) {
    raised = raised_sizes(*sizes, smallest, opened.info(), halvings);
  }
  if (sizes) sizes.emplace(sizes->scaled(std::ldexp(1.0, halvings)));
  const StoppableVolume from_file(opened, job.stop);
  KeptInput kept(from_file, job);
  const io::SpeckLimits limits = io::SpeckLimits::of_budget(job.run.store.memory);
  SharedReads shared(kept.volume(), job.run.store.memory - limits.memory);
  const io::PreparedInput input(shared, job.steps, limits);
  shared.end();
  return_free_memory_above(0);  // the search for specks has let go of more than is held
  FingerprintVolume volume(input.volume());
  Processes& processes = job.run.processes == nullptr ? one_process() : *job.run.processes;
  report::FinishedRun run{.volume = volume.info(),
                          .labels = processes.collect_labels(
                              volume, scanner_count(volume, job.run.threads, job.run.store.memory)),
                          .sizes = asked.settings.sizes,
                          .raised = raised,
                          .specks = input.specks(),
                          .welds = input.welds()};
  run.labels_seconds = meter.read().wall_seconds;
  run.fingerprint = volume.text();
  if (sizes) run.fingerprint += io::text(", sizes ", sizes->fingerprint());
  if (scores != nullptr) run.fingerprint += io::text(", scores ", fingerprint(*scores));
  if (job.labels_known) job.labels_known(run.labels.size());
  const io::DenseVolume labels(input.volume(), run.labels);
  const std::uint64_t beside = std::min(input.held_bytes(), job.run.store.memory);
  const std::uint64_t memory = job.run.store.memory - beside;
  job.run.store.memory_beside = beside;
  if (asked.settings.sizes.count > 0) {
    run.count = count_facts({.labels = labels,
                             .job = asked,
                             .image = sizes ? &*sizes : nullptr,
                             .memory = memory,
                             .memory_beside = beside},
                            run);
    job.settings = with_scale(asked.settings, run.count->scale);
    run.sizes = job.settings.sizes;
    if (sizes) sizes.emplace(sizes->scaled(run.count->scale));
    check(opened.info(), job.settings);
  }
  check_interfaces(job.connect, run.labels);
  const std::uint64_t standing = standing_bytes(labels, job.settings, job.run);
  plan = beside_others(plan, job, beside + standing + io::ScratchMesh::kBufferBytes);
  job.run.store.buffers_grow = kSortsShare + (plan.why_not.empty() ? kCertificateShare : 0);
  const io::MeshPromises promises = promises_of(asked.settings, halvings);
  FinishTask task = looking_task(job, run);
  task.leaves_values_out = job.leaves_values_out;
  task.cut = cut_task(halvings, asked, labels.info());
  task.connect.options = job.connect;
  task.connect.options.watched = sized_interfaces(job, run.labels);
  if (plan.why_not.empty()) {
    task.certificate.emplace(certificate_task(plan, job, labels, promises));
  }
  std::optional<ImageSampler> sampler;
  if (!job.samples.empty()) {
    sampler.emplace(job.samples, opened.info(), thread_count(job.run.threads));
    task.samples = &*sampler;
  }
  io::ScratchMesh mesh(job.folder.empty() ? "." : job.folder);
  FinishSink sink(mesh, task, {sinks.begin(), sinks.end()});
  try {
    RunHooks hooks = run_hooks(job, run, memory);
    hooks.sizes = sizes ? &*sizes : nullptr;
    hooks.keep.opened = kept.folder();
    hooks.keep.begin = [&kept] { kept.begin(); };
    run.engine = march(labels, job, sink, std::move(hooks));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kCheckFailed) {
      refuse_changed_input(input.volume(), volume.sum(), job.run.threads);
    }
    throw;
  }
  run.engine.halvings = halvings;
  if (sink.facts()) run.take(*sink.facts());
  const MeshSize size{run.engine.vertices, run.engine.tets};
  if (job.delivered) job.delivered();
  if (job.delta != Delta::kNo && kept.knows_delta()) {
    run.delta = kept.delta(input.volume(), job, size);
    if (job.tell) job.tell(*run.delta);
  }
  kept.finish(job.steps, size);
  if (run.engine.keep) run.engine.keep->voxels_read = kept.voxels_read();
  if (sampler) run.samples = sampler->facts();
  run.radius_ratio_floor = floor_of(promises);
  run.why_no_certificate = plan.why_not;
  run.why_no_volumes = scores != nullptr ? kVolumesOfScores : why_no_volumes(promises);
  run.resources = meter.read();
  return run;
}

}  // namespace

report::FinishedRun mesh(const io::LabelVolume& opened, const MeshJob& job,
                         std::span<io::MeshSink* const> sinks) {
  const io::WaitStop waits(&job.stop);
  const KeepOptions& keep = job.run.keep;
  try {
    if (keep.use != KeepUse::kUpdate) return mesh_and_keep(opened, job, sinks);
    const PlacedVolume placed(opened, settled_space(keep.folder, opened.info().space));
    return mesh_and_keep(placed, job, sinks);
  } catch (const DamagedWork& damage) {
    fail_damaged(damage, job.run);
  }
}

}  // namespace mw::engine
