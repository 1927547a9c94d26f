// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The box of a volume: its planes and corners, with room for other tools' rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// The six planes of [origin, origin + shape * spacing], as computed in double.  A point is on one
/// within 1e-9 of the extent, or within the rounding of coordinates so far from 0 if that is more.
class BoxPlanes {
 public:
  BoxPlanes(const Frame& frame, Index3 shape) {
    const std::array<std::int64_t, 3> count{shape.x, shape.y, shape.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double extent = static_cast<double>(count[k]) * frame.spacing[k];
      planes_[k] = {frame.origin[k], frame.origin[k] + extent};
      const double farthest = std::max(std::abs(planes_[k][0]), std::abs(planes_[k][1]));
      const double rounding = kUnitsInLastPlace * std::numeric_limits<double>::epsilon() * farthest;
      tolerance_[k] = std::max(kTolerance * extent, rounding);
      volume_ *= extent;
      volume_rounding_ += 2 * rounding / extent;
    }
    volume_rounding_ *= volume_;
  }

  [[nodiscard]] double volume() const { return volume_; }
  /// How far off the sum of the volumes inside may be because coordinates are rounded, if all
  /// points of each plane are off by kUnitsInLastPlace.
  [[nodiscard]] double volume_rounding() const { return volume_rounding_; }

  [[nodiscard]] bool contains(const Position& p) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const bool inside =
          p[k] >= planes_[k][0] - tolerance_[k] && p[k] <= planes_[k][1] + tolerance_[k];
      if (!inside) return false;
    }
    return true;
  }

  /// True when one plane holds all three.
  [[nodiscard]] bool share_plane(const std::array<const Position*, 3>& points) const {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t end = 0; end < 2; ++end) {
        if (is_on(*points[0], k, end) && is_on(*points[1], k, end) && is_on(*points[2], k, end)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Tells which corner of the box the point is; bit k stands for the upper end of axis k.
  [[nodiscard]] std::optional<std::size_t> corner_at(const Position& p) const {
    std::size_t corner = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_on(p, k, 1)) {
        corner |= std::size_t{1} << k;
      } else if (!is_on(p, k, 0)) {
        return std::nullopt;
      }
    }
    return corner;
  }

  /// Is the point on the low (0) or the high (1) plane of an axis?
  [[nodiscard]] bool is_on(const Position& p, std::size_t axis, std::size_t end) const {
    return std::abs(p[axis] - planes_[axis][end]) <= tolerance_[axis];
  }

 private:
  static constexpr double kTolerance = 1e-9;
  /// Three products and sums make a coordinate; other tools have some of their own.
  static constexpr double kUnitsInLastPlace = 8;

  std::array<std::array<double, 2>, 3> planes_{};
  std::array<double, 3> tolerance_{};
  double volume_ = 1;
  double volume_rounding_ = 0;
};

}  // namespace mw::audit
