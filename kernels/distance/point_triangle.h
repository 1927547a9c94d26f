// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distance from a point to a triangle.
#pragma once

#include <array>

#include "kernels/core/metric.h"

namespace mw {

/// Squared distance from p to the nearest point of triangle t, degenerate ones included.
[[nodiscard]] double squared_distance(const Vec3& p, const std::array<Vec3, 3>& t);

}  // namespace mw
