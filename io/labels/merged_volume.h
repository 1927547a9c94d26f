// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume in which some labels have become others (--merge), and what its labels are called.
#pragma once

#include <vector>

#include "io/labels/label_table.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// All labels of `from` become `to`, which may be a new label or one of the volume.
struct MergeRule {
  std::vector<RawLabel> from;
  RawLabel to = 0;
  bool to_is_negative = false;  ///< `to` was written with a minus sign
};

/// All rules apply at once: no rule changes what another one makes.
/// Thread safety: as the volume below, which must outlive it.
class MergedVolume : public VolumeView {
 public:
  /// Reads the volume until it has met every label of the rules.
  /// ERRORS: mw::Error(kUsage) for a label that two rules (or one, twice) take, for one that the
  /// volume does not have, and for a `to` that its labels cannot be (signed or unsigned).
  MergedVolume(const LabelVolume& volume, const std::vector<MergeRule>& rules);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  [[nodiscard]] RawLabel merged(RawLabel label) const {
    return from_.contains(label) ? to_[from_.dense(label)] : label;
  }

  VolumeInfo info_;  ///< that of the volume, except for masks
  LabelTable from_;
  std::vector<RawLabel> to_;  ///< by rank in from_
};

/// Returns the labels that these become by the rules, ascending and each once.
[[nodiscard]] std::vector<RawLabel> merged_labels(std::vector<RawLabel> labels,
                                                  const std::vector<MergeRule>& rules);

}  // namespace mw::io
