// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point of a triangle, by its weights at the corners.
#pragma once

#include <array>

#include "kernels/core/metric.h"

namespace mw {

/// Where a point's foot on a triangle is.
struct Foot {
  std::array<double, 3> weights{};  ///< of the corners, not negative; they add up to 1
  double squared_distance = 0.0;
};

/// The foot of p on the triangle with corners 0, a and b; degenerate ones included.
[[nodiscard]] Foot foot_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b);

}  // namespace mw
