// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The steps of the main job in their order.
#include "engine/job/mesh_job.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/finish/passes.h"
#include "engine/job/certificate_plan.h"
#include "engine/job/halving.h"
#include "engine/job/job_count.h"
#include "engine/job/job_finish.h"
#include "engine/job/job_input.h"
#include "engine/job/job_march.h"
#include "engine/job/job_sizes.h"
#include "engine/job/kept_input.h"
#include "engine/labels/reading_tiles.h"
#include "engine/labels/score_crossings.h"
#include "engine/run/processes.h"
#include "engine/settings/promises.h"
#include "engine/system/crew.h"
#include "engine/system/memory.h"
#include "io/file/errors.h"
#include "io/remote/wait_stop.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

/// What sorts for parts and digest may take of the memory, and what a certificate may.
constexpr double kSortsShare = 3.0 / 64;
constexpr double kCertificateShare = 0.25;

/// Settles sizes and settings, and checks that the job can be done.
JobSizes settle(const io::LabelVolume& opened, const MeshJob& asked, MeshJob& job) {
  JobSizes out = settle_sizes(opened.info(), asked, job);
  check_job(opened, job);
  return out;
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
    stages_.end("labels");
    const io::DenseVolume labels(input_.volume(), run_.labels);
    if (asked_.settings.sizes.count > 0) find_count(labels);
    stages_.end("count");
    check_interfaces(job_.connect, run_.labels);
    plan_check(labels);
    while (!finish_into(sinks, labels)) begin_again();
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
    unscaled_ = sizes_.image;
    const PilotTask task{.labels = labels,
                         .job = asked_,
                         .image = unscaled_ ? &*unscaled_ : nullptr,
                         .memory = memory(),
                         .memory_beside = job_.run.store.memory_beside};
    run_.count = count_facts(task, run_);
    take_scale();
    if (is_alone(job_.run.processes)) return;
    // Each of several processes finds for itself what one alone would see at its meshes.
    while (may_be_remade(*run_.count, labels)) {
      const std::uint64_t tets = count_whole(task, run_.count->scale);
      if (!take_next_scale(*run_.count, tets, labels, asked_.settings)) return;
      take_scale();
    }
  }

  /// Settles sizes by the count's scale.
  void take_scale() {
    const double scale = run_.count->scale;
    job_.settings = with_scale(asked_.settings, scale);
    run_.sizes = job_.settings.sizes;
    if (unscaled_) sizes_.image.emplace(unscaled_->scaled(scale));
    check(input_.volume().info(), job_.settings);
  }

  /// Makes ready for another mesh, with the count's next scale.
  void begin_again() {
    run_.count->seconds = meter_.read().wall_seconds - run_.labels_seconds;
    if (run_.engine.work != nullptr) run_.engine.work->discard();
    run_.engine.work.reset();
    job_.run.store.resume = false;
    take_scale();
  }

  /// Marches, and gives the mesh to the sinks, unless it is to be made again.  Returns whether they
  /// have it.
  bool finish_into(std::span<io::MeshSink* const> sinks, const io::DenseVolume& labels) {
    const FinishTask task = passes(labels);
    io::ScratchMesh mesh(job_.folder.empty() ? "." : job_.folder);
    std::optional<FinishFacts> facts;
    bool is_missed = false;
    const auto finish = [&] {
      is_missed = is_alone(job_.run.processes) && run_.count &&
                  may_be_remade(*run_.count, labels) &&
                  take_next_scale(*run_.count, mesh.tet_count(), labels, asked_.settings);
      if (!is_missed) facts = apply_passes(mesh, task, sinks);
    };
    io::ScratchMeshSink sink(mesh, finish, bytes_to_finish(task, sinks));
    march_into(sink, labels);
    if (facts) run_.take(*facts);
    return !is_missed;
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

  /// Returns all passes; none where another process makes them.
  [[nodiscard]] FinishTask passes(const io::DenseVolume& labels) {
    if (!speaks(job_.run.processes)) return {};
    FinishTask out = finish_task(job_, run_);
    out.stages = &stages_;
    out.cut = cut_task(sizes_.halvings, asked_, labels.info());
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
    hooks.stages = &stages_;
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
    // Other work of the process would be told as work of this run.
    if (job_.run.owns_process) run_.stages = stages_.costs();
    run_.resources = meter_.read();
  }

  const ResourceMeter meter_;
  StageMeter stages_;
  const io::LabelVolume& opened_;
  MeshJob asked_;
  MeshJob job_;  ///< with the settings of the marches
  CertificatePlan plan_;
  JobSizes sizes_;
  std::optional<SizeImage> unscaled_;  ///< the image of sizes before the count's scale
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
