// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is done with the labels of a volume before anything else looks at them.
#pragma once

#include <optional>

#include "io/labels/interpolated_volume.h"
#include "io/labels/merged_volume.h"
#include "io/labels/specks.h"
#include "io/labels/welded_volume.h"

namespace mw::io {

/// The steps in their order.  A crop comes before them (OpenOptions), --labels and --background
/// after them.
struct InputSteps {
  std::vector<MergeRule> merge;     ///< empty: none
  std::optional<SpeckRule> specks;  ///< empty: none
  bool interpolate = false;         ///< labels between thick slices (InterpolatedVolume)
  std::vector<RawLabel> weld;       ///< labels that are filled (WeldedVolume); empty: none
};

/// Returns the facts of a volume after the steps.  ERRORS: those of interpolated_info().
[[nodiscard]] inline VolumeInfo info_after(const InputSteps& steps, const VolumeInfo& opened) {
  return steps.interpolate ? interpolated_info(opened) : opened;
}

/// A volume after the steps.  All that is promised of a mesh refers to it, and the fingerprint of a
/// run is made from it.
class PreparedInput {
 public:
  /// opened must outlive it.  limits bound the search for specks and what is welded.
  /// ERRORS: those of MergedVolume, DespeckledVolume, InterpolatedVolume and WeldedVolume.
  PreparedInput(const LabelVolume& opened, const InputSteps& steps, const SpeckLimits& limits = {})
      : volume_(&opened) {
    if (!steps.merge.empty()) volume_ = &merged_.emplace(*volume_, steps.merge);
    if (steps.specks) volume_ = &despeckled_.emplace(*volume_, *steps.specks, limits);
    if (steps.interpolate) volume_ = &interpolated_.emplace(*volume_);
    if (!steps.weld.empty()) volume_ = &welded_.emplace(*volume_, steps.weld, limits.memory);
  }

  PreparedInput(const PreparedInput&) = delete;
  PreparedInput& operator=(const PreparedInput&) = delete;

  [[nodiscard]] const LabelVolume& volume() const { return *volume_; }
  /// Empty when no specks were to be dropped.
  [[nodiscard]] std::optional<SpeckFacts> specks() const {
    return despeckled_ ? std::optional(despeckled_->facts()) : std::nullopt;
  }
  /// Empty when no labels were made between slices.
  [[nodiscard]] std::optional<SliceFacts> slices() const {
    return interpolated_ ? std::optional(interpolated_->facts()) : std::nullopt;
  }
  /// Empty when nothing was to be welded.
  [[nodiscard]] std::optional<WeldFacts> welds() const {
    return welded_ ? std::optional(welded_->facts()) : std::nullopt;
  }
  /// Returns the bytes that the steps hold.
  [[nodiscard]] std::uint64_t held_bytes() const {
    return (despeckled_ ? despeckled_->held_bytes() : 0) + (welded_ ? welded_->held_bytes() : 0);
  }

 private:
  const LabelVolume* volume_;  ///< the result of the last step, or the one that was opened
  std::optional<MergedVolume> merged_;
  std::optional<DespeckledVolume> despeckled_;
  std::optional<InterpolatedVolume> interpolated_;
  std::optional<WeldedVolume> welded_;
};

}  // namespace mw::io
