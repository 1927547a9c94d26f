// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output to input: proof that a triangle stays near the input's boundary of both its labels.
#pragma once

#include <array>

#include "kernels/core/label.h"
#include "kernels/core/metric.h"

namespace mw {

/// Proofs aim this much below a bound, against rounding in the last bits.
inline constexpr double kRoundingGuard = 1e-9;

/// Decides whether all of a triangle between labels A and B lies within D of the input's boundary
/// of A and of B.
///
/// A ball that holds points of A and of B holds points of both boundaries, so it is enough that
/// each point of the triangle has an A voxel and a B voxel within D.  The distance to one voxel is
/// a convex function: when the three corners are within D of the same voxel, so is the whole
/// triangle.  Otherwise the longest edge is halved, and each half finds voxels of its own.
/// Coordinates are in voxels.
class LabelReach {
 public:
  using Triangle = std::array<Vec3, 3>;

  /// REQUIRES: max_distance > 0; `labels` covers every triangle asked for and search_reach() around
  /// it (voxels outside of `labels` count as neither label).
  LabelReach(const LabelBox& labels, double max_distance);

  /// How far around a triangle the search looks at voxels.
  [[nodiscard]] static std::int64_t search_reach(double max_distance);

  /// ENSURES: true only where the bound holds; false only where some point of the triangle breaks
  /// it, or comes within a small fraction of D of breaking it.
  [[nodiscard]] bool within(const Triangle& triangle, Label a, Label b) const;

 private:
  /// Labels still to be found near a piece; kExterior stands for none.
  struct Wanted {
    Label a = kExterior;
    Label b = kExterior;
    [[nodiscard]] bool nothing() const { return a == kExterior && b == kExterior; }
  };

  [[nodiscard]] bool prove(const Triangle& t, Wanted wanted) const;
  /// Returns those wanted labels of which no voxel is near all three corners.
  [[nodiscard]] Wanted unseen(const Triangle& t, Wanted wanted) const;
  [[nodiscard]] Box3 voxels_near(const Triangle& t) const;

  const LabelBox& labels_;
  double max_distance_;
  double squared_distance_;
  double squared_smallest_;
};

}  // namespace mw
