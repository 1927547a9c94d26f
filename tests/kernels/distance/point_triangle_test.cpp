// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distance to a triangle against a dense walk over it.
#include "kernels/distance/point_triangle.h"

#include <gtest/gtest.h>

#include "tests/kernels/distance/random_points.h"

namespace mw::test {
namespace {

/// Least squared distance over a barycentric grid; no less than the true one.
double walked(const Vec3& p, const std::array<Vec3, 3>& t, int steps) {
  double best = (p - t[0]).squaredNorm();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      const Vec3 x = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      best = std::min(best, (p - x).squaredNorm());
    }
  }
  return best;
}

TEST(PointTriangle, IsTheLeastDistanceOverTheTriangle) {
  std::mt19937 random(901);
  constexpr int kSteps = 60;
  for (int i = 0; i < 600; ++i) {
    std::array<Vec3, 3> t{random_point(random), random_point(random), random_point(random)};
    if (i % 5 == 0) t[2] = 0.5 * (t[0] + t[1]);  // a segment
    if (i % 17 == 0) t[1] = t[0];
    const Vec3 p = i % 7 == 0 ? Vec3(0.3 * t[0] + 0.3 * t[1] + 0.4 * t[2]) : random_point(random);
    const double exact = std::sqrt(squared_distance(p, t));
    const double grid = std::sqrt(walked(p, t, kSteps));
    const double spacing = ((t[1] - t[0]).norm() + (t[2] - t[0]).norm()) / kSteps;
    EXPECT_LE(exact, grid + 1e-12);
    EXPECT_GE(exact, grid - spacing);
  }
}

}  // namespace
}  // namespace mw::test
