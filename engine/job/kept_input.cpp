// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/kept_input.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include "engine/job/earlier_run.h"
#include "engine/keep/keep_options.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "engine/run/processes.h"
#include "engine/system/crew.h"
#include "engine/verify/verify_mesh.h"
#include "io/file/errors.h"
#include "io/volume/volume_readers.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

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

}  // namespace

KeptInput::KeptInput(const io::LabelVolume& opened, const MeshJob& job)
    : counted_(opened), memory_(job.run.store.memory) {
  const KeepOptions& options = job.run.keep;
  if (options.folder.empty() || !speaks(job.run.processes)) return;
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

void KeptInput::begin() {
  if (folder_ == nullptr) return;
  if (patched_) refuse_untold_change();
  folder_->begin_change(changed_);
  after_ = std::make_unique<io::AtomicFile>(folder_->path() / kLabelsFile);
  write_kept_labels(volume(), *after_, scanner_count(volume(), 1, memory_));
  folder_->expect_labels(after_->appended());
}

io::Json KeptInput::delta(const io::LabelVolume& after, const MeshJob& job,
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

void KeptInput::finish(const io::InputSteps& steps, const MeshSize& size) {
  if (folder_ == nullptr) return;
  const std::uint64_t numbering = counted_.info().numbering;
  append_note(*after_, io::text(size.vertices, " ", size.tets, " ", numbering, " ",
                                folder_->number(), "\n") +
                           text_of(steps));
  after_->commit();
  folder_->end_change();
}

KeptInput::Note KeptInput::parse_note(const std::string& note) {
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

void KeptInput::open_before(const MeshJob& job) {
  const KeepOptions& options = job.run.keep;
  if (options.changed.empty() && job.delta == Delta::kNo) return;
  const std::filesystem::path file = folder_->path() / kLabelsFile;
  const std::string folder = folder_->path().string();
  before_ = KeptLabels::open(file, counted_.info().shape);
  if (before_) return take_before(options);
  if (std::error_code ignored; std::filesystem::exists(file, ignored)) {
    io::fail_usage(folder +
                   ": was kept of a volume of another shape; give that volume, edited, or "
                   "delete the folder and begin it by --keep");
  }
  if (job.delta == Delta::kOn) {
    io::fail_usage("--delta: no run was complete in " + folder + ", there is nothing before");
  }
  if (options.say && !options.changed.empty()) {
    options.say(folder + ": no run was complete here, so all labels are read, not only --changed");
  }
}

void KeptInput::take_before(const KeepOptions& options) {
  note_ = parse_note(before_->note());
  if (note_.folder != folder_->number()) {
    throw DamagedWork(kLabelsFile, "it is of another folder");
  }
  is_renumbered_ = note_.numbering != counted_.info().numbering;
  if (options.say && is_renumbered_ && !options.changed.empty()) {
    options.say(folder_->path().string() +
                ": labels have other numbers than in the last run here, since these depend on "
                "all masks; all labels are read, not only --changed");
  }
}

void KeptInput::refuse_untold_change() const {
  const auto box = patched_->untold_change(scanner_count(counted_, 1, memory_));
  if (!box) return;
  const Index3 lo = box->lo + counted_.info().first, hi = box->hi + counted_.info().first;
  io::fail_usage(
      "--changed: labels have changed outside of its boxes, too: those of the tile from ", lo.x,
      ",", lo.y, ",", lo.z, " to ", hi.x, ",", hi.y, ",", hi.z,
      " are not those of the last run in ", folder_->path().string(),
      "; give all boxes that changed, or leave --changed out, so that all is read");
}

}  // namespace mw::engine
