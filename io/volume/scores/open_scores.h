// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels out of probabilities or signed distances, and the files that these are opened from.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// One number for each voxel, and what is known about it.
struct ScoreComponent {
  std::shared_ptr<const LabelVolume> volume;  ///< a NumberVolume, too
  std::string name;                           ///< what errors call it
};

/// Gives each voxel the label of the highest score, and the smallest of several.
/// - Several probabilities are the scores of labels 0, 1, 2 and so on.
/// - One probability is that of label 1; label 0 has a half everywhere, so label 1 is at p > 0.5.
/// - Distances with their sign turned are the scores of labels 1, 2 and so on; label 0 has the
///   score 0, so it is where no distance is negative.
/// Memory: read() takes 4 MiB a thread.
class ScoredLabels : public LabelVolume, public LabelScores {
 public:
  /// names are those of the labels.
  /// REQUIRES: at least one component, all of one shape; values is not kLabels.
  ScoredLabels(std::vector<ScoreComponent> components, VoxelValues values, LabelNames names);

  /// Whether label 0 has a score that no component gives.
  [[nodiscard]] static bool has_ground(std::size_t components, VoxelValues values) {
    return values == VoxelValues::kDistances || components == 1;
  }

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  /// ERRORS: those of the components; mw::Error(kInput) naming the component and the voxel whose
  /// value is not a number, or a probability that is more than 1e-3 outside of 0 to 1.
  void read(const Box3& box, std::span<RawLabel> out) const override;
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override;
  void drop_buffers() const override;

  [[nodiscard]] const LabelScores* scores() const override { return this; }
  [[nodiscard]] Index3 shape() const override { return info_.shape; }
  [[nodiscard]] std::size_t labels() const override {
    return components_.size() + (has_ground_ ? 1 : 0);
  }
  void read_scores(RawLabel label, const Box3& box, std::span<double> out) const override;

 private:
  void read_part(const Box3& part, const Box3& box, std::span<RawLabel> out) const;
  void check_numbers(RawLabel label, const Box3& box, std::span<const double> scores) const;
  [[nodiscard]] const ScoreComponent& component_of(RawLabel label) const {
    return components_[static_cast<std::size_t>(label) - (has_ground_ ? 1 : 0)];
  }

  std::vector<ScoreComponent> components_;
  VoxelValues values_;
  bool has_ground_;
  VolumeInfo info_;
};

/// Opens one file, or several: "A,B,C", whose components follow each other.  Where each file has
/// one component, labels have the names of the files, else those that the first file tells.
/// open() opens one file as OpenOptions say.  options.crop is ignored.
/// ERRORS: mw::Error(kInput) naming the file that lies elsewhere than the first, or whose format
/// has no numbers; kUsage for options of masks.
[[nodiscard]] std::unique_ptr<LabelVolume> open_scores(
    const std::filesystem::path& path, const OpenOptions& options,
    const std::function<std::unique_ptr<LabelVolume>(const std::filesystem::path&,
                                                     const OpenOptions&)>& open);

}  // namespace mw::io
