// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Random positions for tests of distances.
#pragma once

#include "kernels/core/metric.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::test {

/// A point of the cube [0, edge]^3, in steps of 1/1000.
[[nodiscard]] inline Vec3 random_point(std::mt19937& random, double edge = 4.0) {
  const auto coordinate = [&] {
    return edge * static_cast<double>(audit::test::below(random, 1001)) / 1000.0;
  };
  const double x = coordinate(), y = coordinate();
  return {x, y, coordinate()};
}

}  // namespace mw::test
