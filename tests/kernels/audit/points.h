// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Points in voxels, for tests that measure by themselves.
#pragma once

#include "tests/testing.h"

namespace mw::audit::test {

using Point = std::array<double, 3>;

/// a for 0, b for 1.
[[nodiscard]] inline Point along(const Point& a, const Point& b, double t) {
  Point p{};
  for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + t * (b[k] - a[k]);
  return p;
}

[[nodiscard]] inline double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace mw::audit::test
