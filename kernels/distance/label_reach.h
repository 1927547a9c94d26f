// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output to input: proof that a triangle stays near the input's boundary of both its labels.
#pragma once

#include <array>

#include "kernels/core/label_box.h"
#include "kernels/core/metric.h"

namespace mw {

/// Decides whether all of a triangle between labels A and B lies within D of the input's boundary
/// of A and of B.
///
/// A ball that holds points of A and of B holds points of both boundaries, so at a point x the
/// larger of the distances to the nearest A voxel and to the nearest B voxel bounds both.  That
/// function is 1-Lipschitz: when its value at the centroid plus the distance to the farthest corner
/// is at most D, the whole triangle is proved; otherwise the longest edge is halved.
/// Coordinates are in voxels.  Voxels farther than the search reach are not seen, so the proof may
/// fail where a bound holds, never the other way round.
class LabelReach {
 public:
  /// REQUIRES: max_distance > 0; `labels` covers every triangle asked for and the search reach
  /// around it (voxels outside it count as neither label).
  LabelReach(const LabelBox& labels, double max_distance);

  /// How far around a triangle voxels are looked at.
  [[nodiscard]] static std::int64_t search_reach(double max_distance);

  [[nodiscard]] bool within(const std::array<Vec3, 3>& triangle, Label a, Label b) const;

 private:
  [[nodiscard]] bool prove(const Vec3& p, const Vec3& q, const Vec3& r, Label a, Label b) const;
  [[nodiscard]] double distance(const Vec3& x, Label a, Label b) const;

  const LabelBox& labels_;
  double max_distance_;
  std::int64_t reach_;
};

}  // namespace mw
