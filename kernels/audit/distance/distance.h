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

/// No point of an interface is farther than this from one that was looked at, in voxels, but where
/// distances are known to be no larger than a limit (DistanceTask::limit).
inline constexpr double kCoveringRadius = 0.25;

/// The limit unless another one is given.
inline constexpr double kDistanceLimit = 1.0;

/// The limit where a bound is checked.
[[nodiscard]] inline double distance_limit(const std::optional<double>& bound) {
  return std::min(kDistanceLimit, bound.value_or(kDistanceLimit));
}

/// Distances in voxels.  The largest of each kind is that of a sample, hence a lower bound of the
/// true one-sided Hausdorff distance, which is either larger by no more than kCoveringRadius or no
/// larger than the limit (a distance to a set changes by no more than one walks).
struct DistanceReport {
  /// A label with an interface on one side only has infinite figures, in both directions.
  struct PerLabel {
    /// kUnknown for all labels of the mesh that the volume does not have, kLeftOut for the space
    /// that has no tets because labels were left out.
    Label label = 0;
    double input_to_mesh_max = 0;
    double input_to_mesh_mean = 0;
    double mesh_to_input_max = 0;
    double mesh_to_input_mean = 0;

    [[nodiscard]] double max() const;
    [[nodiscard]] bool is_finite() const;
  };

  double max_voxels = 0;   ///< over all labels and both directions
  double mean_voxels = 0;  ///< the same, by area: each face and triangle counts once a label
  std::vector<PerLabel> per_label;  ///< labels with an interface on some side, ascending
  std::vector<Label> only_in_volume;
  std::vector<Label> only_in_mesh;
  double limit = kDistanceLimit;
  /// Samples farther than what was looked at around them: they count as that far.
  std::uint64_t far_samples = 0;

  [[nodiscard]] bool is_finite() const { return only_in_volume.empty() && only_in_mesh.empty(); }
  /// The first label with the largest finite distance; nullptr when no label has one.
  [[nodiscard]] const PerLabel* farthest() const;
};

/// P4.  A label's boundary are the voxel faces, or the triangles, between it and another label of
/// the volume; the box is none.  Lengths are in voxels along each axis: (p - origin) / spacing.
/// Means are by area, of the centres of every fourth voxel face and of pieces of triangles.
/// For a mesh from which labels were left out, boundaries of kept labels are also its triangles of
/// one tet that are not on the box.  Those are samples of kLeftOut as well, held against the faces
/// of all labels that were left out: no such triangle may be where none of these labels is.  The
/// other way round nothing is known of them.
/// REQUIRES: as voxel_betti and mesh_betti; finite vertices; positive spacing.
/// Errors: kInput when the mesh is none, kResource above 2^20 voxels along an axis.
/// Cost: see measure_distances().  Deterministic, one thread.
[[nodiscard]] DistanceReport measure_distance(const VoxelLabels& volume, std::size_t label_count,
                                              const AuditMesh& mesh, const Frame& frame,
                                              const KeptLabels& kept = {},
                                              double limit = kDistanceLimit);

/// What the figures mean, in words.
[[nodiscard]] std::string sampling_text(const DistanceReport& report);

}  // namespace mw::audit
