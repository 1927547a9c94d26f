// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From lattice positions to lengths: the only place where anisotropic spacing enters the kernels.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/core/lattice.h"

namespace mw {

using Vec3 = Eigen::Vector3d;

/// Length of a lattice unit along each axis, with the smallest voxel edge as the unit of length.
/// Orientation does not change under axis scaling, so validity never asks for a metric; quadrics,
/// edge length variance and radius ratio do.
class Metric {
 public:
  Metric() : Metric({1.0, 1.0, 1.0}) {}

  /// REQUIRES: spacing finite and positive.
  explicit Metric(const std::array<double, 3>& spacing) {
    const double smallest = *std::min_element(spacing.begin(), spacing.end());
    for (int i = 0; i < 3; ++i) {
      unit_[i] = spacing[static_cast<std::size_t>(i)] / smallest / kUnitsPerVoxel;
    }
  }

  /// The vector from a to b.
  [[nodiscard]] Vec3 vector(Point a, Point b) const {
    return {(b.x - a.x) * unit_[0], (b.y - a.y) * unit_[1], (b.z - a.z) * unit_[2]};
  }

  /// Edge lengths of a cell of the lattice.
  [[nodiscard]] const Vec3& unit() const { return unit_; }
  /// Edge lengths of a voxel.
  [[nodiscard]] Vec3 voxel() const { return unit_ * kUnitsPerVoxel; }

  /// The lattice point nearest to origin + offset.  ERRORS: none; offsets are clamped to the
  /// largest extent of a tetrahedron, beyond which no move is accepted anyway, and an offset that
  /// is not a number counts as this extent.
  [[nodiscard]] Point moved(Point origin, const Vec3& offset) const {
    return {origin.x + nearest(offset[0] / unit_[0]), origin.y + nearest(offset[1] / unit_[1]),
            origin.z + nearest(offset[2] / unit_[2])};
  }

 private:
  static std::int32_t nearest(double units) {
    constexpr double kLimit = kMaxTetExtent;
    // With its arguments in this order, std::min returns the limit where `units` is NaN.
    const double within = std::max(-kLimit, std::min(kLimit, units));
    // A cast rounds down where numbers are positive, so the limit is added first.
    return static_cast<std::int32_t>(within + (0.5 + kLimit)) - kMaxTetExtent;
  }

  Vec3 unit_;
};

}  // namespace mw
