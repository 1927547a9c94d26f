// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point of a triangle, by its weights at the corners.
#pragma once

#include <array>

#include "kernels/core/metric.h"
#include "kernels/distance/point_triangle.h"

namespace mw {

/// Where a point's foot on a triangle is.
struct Foot {
  std::array<double, 3> weights{};  ///< of the corners, not negative; they add up to 1
  double squared_distance = 0.0;
};

/// The foot of p on the triangle with corners 0, a and b; degenerate ones included.
[[nodiscard]] Foot foot_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b);

/// Feet of some points at once.
struct FeetInside {
  unsigned points = 0;      ///< one bit for each whose foot has positive weights
  StoredLanes at_corner{};  ///< weights of corner 0, of those
};

/// Those on the triangle with corners 0, a and b; none when it is degenerate.
[[nodiscard]] FeetInside feet_inside(const PointLanes& p, const Vec3& a, const Vec3& b);

}  // namespace mw
