// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/job_input.h"

#include "engine/job/earlier_run.h"
#include "engine/labels/reading_tiles.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/settings/together.h"
#include "engine/system/crew.h"
#include "engine/verify/verify_mesh.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"
#include "io/volume/decode.h"
#include "io/volume/volume_readers.h"

namespace mw::engine {
namespace {

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

void warn(const MeshJob& job, const std::string& line) {
  if (job.warn && !line.empty()) job.warn(line);
}

}  // namespace

std::uint64_t bytes_to_read(const io::LabelVolume& opened, const io::InputSteps& steps) {
  return reader_bytes(opened) + (steps.interpolate ? io::InterpolatedVolume::kReadBytes : 0);
}

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

void refuse_changed_input(const io::LabelVolume& volume, std::uint64_t first, int threads) {
  const FingerprintVolume again(volume);
  static_cast<void>(collect_labels(again, threads));
  if (again.sum() != first) io::fail_input_changed();
}

}  // namespace mw::engine
