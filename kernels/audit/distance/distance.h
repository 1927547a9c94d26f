// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How far the mesh's label boundaries are from the input's, both ways (promise P4).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// No point of an interface is farther than this, in voxels, from a point that was measured, except
/// where distances are known to be no larger than a limit (DistanceTask::limit).
inline constexpr double kCoveringRadius = 0.25;

/// The limit if no other one is given.
inline constexpr double kDistanceLimit = 1.0;

/// The limit for a check of distances against a bound.
[[nodiscard]] inline double distance_limit(const std::optional<double>& bound) {
  return std::min(kDistanceLimit, bound.value_or(kDistanceLimit));
}

/// Distances in voxels.  The largest of each kind is that of a sample, hence a lower bound of the
/// true one-sided Hausdorff distance, which is either larger by no more than kCoveringRadius or no
/// larger than the limit (a distance to a set changes by no more than one walks).
struct DistanceReport {
  /// A label with an interface on one side only has infinite figures, in both directions.
  struct PerLabel {
    /// kUnknown stands for all labels of the mesh that the volume does not have, kLeftOut for the
    /// space that has no tets because labels were left out.
    Label label = 0;
    double input_to_mesh_max = 0;
    double input_to_mesh_mean = 0;
    double mesh_to_input_max = 0;
    double mesh_to_input_mean = 0;

    [[nodiscard]] double max() const;
    [[nodiscard]] bool is_finite() const;
  };

  double max_voxels = 0;            ///< over all labels and both directions
  double mean_voxels = 0;           ///< mean by area; a face or triangle counts once for each label
  std::vector<PerLabel> per_label;  ///< labels with an interface on some side, ascending
  std::vector<Label> only_in_volume;
  std::vector<Label> only_in_mesh;
  double limit = kDistanceLimit;
  /// Samples with nothing in reach of the search; they count as that reach away.
  std::uint64_t far_samples = 0;

  [[nodiscard]] bool is_finite() const { return only_in_volume.empty() && only_in_mesh.empty(); }
  /// The first label with the largest finite distance; nullptr when no label has one.
  [[nodiscard]] const PerLabel* farthest() const;
};

/// Says in words what the figures mean.
[[nodiscard]] std::string sampling_text(const DistanceReport& report);

}  // namespace mw::audit
