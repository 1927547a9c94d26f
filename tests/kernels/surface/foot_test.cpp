// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Feet of points on triangles, against distances found another way and against many points.
#include "kernels/surface/foot.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "kernels/distance/point_triangle.h"
#include "tests/kernels/distance/random_points.h"

namespace mw::test {
namespace {

using audit::test::below;

/// Corners a and b; every fourth triangle is a line or a point.
std::pair<Vec3, Vec3> random_sides(std::mt19937& random, int i) {
  const Vec3 a = random_point(random) - Vec3::Constant(2.0);
  switch (i % 16) {
    case 0:
      return {Vec3::Zero(), Vec3::Zero()};
    case 4:
      return {a, a};
    case 8:
      return {a, Vec3::Zero()};
    case 12:
      return {a, -0.5 * a};
    default:
      return {a, random_point(random) - Vec3::Constant(2.0)};
  }
}

TEST(Foot, IsTheNearestPoint) {
  std::mt19937 random(1101);
  int inside = 0, on_edge = 0, at_corner = 0;
  for (int i = 0; i < 8000; ++i) {
    const auto [a, b] = random_sides(random, i);
    const Vec3 p = random_point(random) - Vec3::Constant(2.0);
    const Foot foot = foot_on_triangle(p, a, b);
    const auto& w = foot.weights;
    for (const double weight : w) ASSERT_GE(weight, 0.0);
    ASSERT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-12);
    ASSERT_NEAR((p - w[1] * a - w[2] * b).squaredNorm(), foot.squared_distance, 1e-10);
    const DistanceTriangle triangle({Vec3::Zero(), a, b});
    ASSERT_NEAR(foot.squared_distance, triangle.squared_distance(p), 1e-9);
    const auto zeros = std::count(w.begin(), w.end(), 0.0);
    (zeros == 0 ? inside : zeros == 1 ? on_edge : at_corner) += 1;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(on_edge, 500);
  EXPECT_GT(at_corner, 500);
}

TEST(Foot, IsAsNearAsAnyOfManyPoints) {
  constexpr int kSteps = 40;
  std::mt19937 random(1102);
  for (int i = 0; i < 200; ++i) {
    const auto [a, b] = random_sides(random, i);
    const Vec3 p = random_point(random) - Vec3::Constant(2.0);
    const double distance = std::sqrt(foot_on_triangle(p, a, b).squared_distance);
    double nearest = 1e9;
    for (int k = 0; k <= kSteps; ++k) {
      for (int l = 0; k + l <= kSteps; ++l) {
        nearest = std::min(nearest, (p - (k * a + l * b) / kSteps).norm());
      }
    }
    EXPECT_LE(distance, nearest + 1e-12);
    EXPECT_GE(distance, nearest - (a.norm() + b.norm()) / kSteps);
  }
}

TEST(Foot, SeveralInsideAreThoseOfEachAlone) {
  std::mt19937 random(1104);
  int inside = 0, outside = 0;
  for (int i = 0; i < 8000; ++i) {
    const auto [a, b] = random_sides(random, i);
    PointLanes points;
    std::array<Vec3, kLanes> single;
    for (std::size_t k = 0; k < kLanes; ++k) {
      single[k] = random_point(random) - Vec3::Constant(2.0);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        points[axis][k] = single[k][static_cast<int>(axis)];
      }
    }
    const FeetInside feet = feet_inside(points, a, b);
    EXPECT_EQ(feet.points >> kLanes, 0U);
    for (std::size_t k = 0; k < kLanes; ++k) {
      const auto& w = foot_on_triangle(single[k], a, b).weights;
      const double least = std::min({w[0], w[1], w[2]});
      const bool is_inside = (feet.points >> k & 1U) != 0;
      // Close to an edge rounding decides.
      ASSERT_TRUE(is_inside || least < 1e-9) << i;
      (is_inside ? inside : outside) += 1;
      if (!is_inside) continue;
      ASSERT_GT(least, -1e-9);
      ASSERT_NEAR(feet.at_corner[k], w[0], 1e-9);
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

/// A point of the triangle is its own foot.
TEST(Foot, OfAPointOfTheTriangleHasItsWeights) {
  std::mt19937 random(1103);
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random_point(random), b = random_point(random);
    if (a.cross(b).norm() < 0.1) continue;
    const double u = below(random, 11) / 10.0, v = (1.0 - u) * below(random, 11) / 10.0;
    const Foot foot = foot_on_triangle(u * a + v * b, a, b);
    EXPECT_NEAR(foot.squared_distance, 0.0, 1e-12);
    EXPECT_NEAR(foot.weights[1], u, 1e-9);
    EXPECT_NEAR(foot.weights[2], v, 1e-9);
  }
}

}  // namespace
}  // namespace mw::test
