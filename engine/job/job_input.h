// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The volume of a job: where it lies, what is checked before and after it is read, and its labels.
#pragma once

#include <functional>

#include "engine/job/mesh_job.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/texture_volume.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

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

/// Returns what a thread takes that reads the volume after the steps.
[[nodiscard]] std::uint64_t bytes_to_read(const io::LabelVolume& opened,
                                          const io::InputSteps& steps);

/// Checks before any label is read that the job, whose sizes are settled, can be done.
/// ERRORS: mw::Error(kUsage); those of check() and io::check_unpacking().
void check_job(const io::LabelVolume& opened, const MeshJob& job);

/// Returns all labels, and warns if some were rounded.  ERRORS: mw::Error(kUsage) for an image.
[[nodiscard]] io::LabelTable first_pass(FingerprintVolume& volume, const TextureVolume& texture,
                                        const MeshJob& job);

/// Throws if the labels are not those that were read first, which explains a mesh that does not
/// pass its check.
void refuse_changed_input(const io::LabelVolume& volume, std::uint64_t first, int threads);

}  // namespace mw::engine
