// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The box of a volume: its planes and corners, with room for other tools' rounding.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// The six planes of [origin, origin + shape * spacing], as computed in double.
class BoxPlanes {
 public:
  BoxPlanes(const Frame& frame, Index3 shape) {
    const std::array<std::int64_t, 3> count{shape.x, shape.y, shape.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double extent = static_cast<double>(count[k]) * frame.spacing[k];
      planes_[k] = {frame.origin[k], frame.origin[k] + extent};
      tolerance_[k] = kTolerance * extent;
      volume_ *= extent;
    }
  }

  [[nodiscard]] double volume() const { return volume_; }

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

  /// Which corner the point is, bit k for the upper end of axis k.
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

 private:
  static constexpr double kTolerance = 1e-9;

  [[nodiscard]] bool is_on(const Position& p, std::size_t axis, std::size_t end) const {
    return std::abs(p[axis] - planes_[axis][end]) <= tolerance_[axis];
  }

  std::array<std::array<double, 2>, 3> planes_{};
  std::array<double, 3> tolerance_{};
  double volume_ = 1;
};

}  // namespace mw::audit
