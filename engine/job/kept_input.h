// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run reads that keeps something for later ones, and what it leaves them of its labels.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/job/mesh_job.h"
#include "engine/job/volume_delta.h"
#include "engine/keep/keep_folder.h"
#include "engine/keep/kept_labels.h"
#include "io/file/sink/atomic_file.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

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

/// The labels of a run that keeps something, and those that it leaves for the next one.  With
/// several processes the one that speaks leaves them.
class KeptInput {
 public:
  /// ERRORS: those of KeepFolder and KeptLabels; mw::Error(kUsage) when the labels before are those
  /// of a volume of another shape, and for Delta::kOn when no run before was complete.
  KeptInput(const io::LabelVolume& opened, const MeshJob& job);

  /// Must be called before the run keeps anything: from here on its labels may be in the folder.
  /// ERRORS: mw::Error(kUsage) when labels outside of the boxes that were told have changed.
  void begin();

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
                               const MeshSize& size) const;

  /// Must be called once the run is complete.
  void finish(const io::InputSteps& steps, const MeshSize& size);

 private:
  /// What finish() says of a run beside its labels.
  struct Note {
    std::optional<MeshSize> size;
    std::uint64_t numbering = 0;
    std::uint64_t folder = 0;  ///< KeepFolder::number()
    io::InputSteps steps;
  };

  static Note parse_note(const std::string& note);
  void open_before(const MeshJob& job);
  void take_before(const KeepOptions& options);
  void refuse_untold_change() const;

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

}  // namespace mw::engine
