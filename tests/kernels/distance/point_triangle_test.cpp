// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distance to a triangle against a dense walk over it.
#include <Eigen/Geometry>

#include "kernels/distance/interface_fan.h"
#include "kernels/distance/point_triangle.h"
#include "tests/kernels/distance/random_points.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

using namespace audit::test;

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
    const double exact = std::sqrt(DistanceTriangle(t).squared_distance(p));
    const double grid = std::sqrt(walked(p, t, kSteps));
    const double spacing = ((t[1] - t[0]).norm() + (t[2] - t[0]).norm()) / kSteps;
    EXPECT_LE(exact, grid + 1e-12);
    EXPECT_GE(exact, grid - spacing);
  }
}

/// However its corners are named, and for as many points as one asks.
TEST(PointTriangle, ForgetsTheOrderOfCorners) {
  std::mt19937 random(902);
  for (int i = 0; i < 200; ++i) {
    std::array<Vec3, 3> t{random_point(random), random_point(random), random_point(random)};
    if (i % 4 == 0) t[2] = t[0] + 1e-7 * (t[2] - t[0]);
    const DistanceTriangle one(t), turned({t[1], t[2], t[0]}), mirrored({t[1], t[0], t[2]});
    EXPECT_EQ(one.corners(), t);
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = random_point(random);
      EXPECT_NEAR(turned.squared_distance(p), one.squared_distance(p), 1e-6);
      EXPECT_NEAR(mirrored.squared_distance(p), one.squared_distance(p), 1e-6);
    }
    for (const Vec3& corner : t) EXPECT_NEAR(one.squared_distance(corner), 0.0, 1e-12);
  }
}

/// Four points at once give what each gives alone, except where rounding may decide.
TEST(PointTriangle, TellsSeveralPointsAtOnce) {
  std::mt19937 random(903);
  constexpr double kRounding = 1e-9;
  int near = 0, beyond = 0;
  for (int i = 0; i < 4000; ++i) {
    std::array<Vec3, 3> t{random_point(random), random_point(random), random_point(random)};
    if (i % 4 == 0) t[2] = 0.5 * (t[0] + t[1]);  // a segment
    if (i % 9 == 0) t[1] = t[0];
    const DistanceTriangle triangle(t);
    const double squared = 0.25 * random_point(random).squaredNorm();
    PointLanes points;
    std::array<Vec3, kLanes> one_by_one;
    for (std::size_t k = 0; k < kLanes; ++k) {
      one_by_one[k] = random_point(random);
      for (int axis = 0; axis < 3; ++axis) {
        points[static_cast<std::size_t>(axis)][k] = one_by_one[k][axis];
      }
    }
    const unsigned bits = triangle.within(points, squared);
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double exact = triangle.squared_distance(one_by_one[k]);
      if (triangle.is_beyond(one_by_one[k], std::sqrt(squared))) {
        EXPECT_GT(exact, squared);
        ++beyond;
      }
      if (std::abs(exact - squared) < kRounding) continue;
      EXPECT_EQ((bits >> k & 1U) != 0, exact < squared);
      near += exact < squared ? 1 : 0;
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_GT(beyond, 500);
}

/// Slivers of every width, down to where only edges count.
TEST(PointTriangle, IsExactForNarrowTriangles) {
  std::mt19937 random(903);
  for (int i = 0; i < 300; ++i) {
    const double width = std::pow(10.0, -(i % 15));
    const Vec3 a = random_point(random), b = random_point(random);
    const std::array<Vec3, 3> t{a, b, 0.4 * a + 0.6 * b + width * random_point(random, 1.0)};
    const Vec3 p = random_point(random);
    const double exact = std::sqrt(DistanceTriangle(t).squared_distance(p));
    const double grid = std::sqrt(walked(p, t, 60));
    EXPECT_LE(exact, grid + 1e-8);
    EXPECT_GE(exact, grid - ((t[1] - t[0]).norm() + (t[2] - t[0]).norm()) / 60);
  }
}

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

TEST(Foot, OfSeveralPointsIsThatOfEach) {
  std::mt19937 random(1105);
  int inside = 0;
  for (int i = 0; i < 8000; ++i) {
    const auto [a, b] = random_sides(random, i);
    PointLanes points;
    std::array<Foot, kLanes> expected;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec3 p = random_point(random) - Vec3::Constant(2.0);
      for (std::size_t axis = 0; axis < 3; ++axis) points[axis][k] = p[static_cast<int>(axis)];
      expected[k] = foot_on_triangle(p, a, b);
    }
    const FootLanes feet = feet_on_triangle({load(points[0]), load(points[1]), load(points[2])}, a,
                                            b, corner_products(a, b));
    for (std::size_t k = 0; k < kLanes; ++k) {
      const auto& w = expected[k].weights;
      const bool is_inside = w[0] > 0.0 && w[1] > 0.0 && w[2] > 0.0;
      ASSERT_EQ(feet.at_corner[k], w[0]) << i;
      ASSERT_EQ(feet.squared_distance[k], expected[k].squared_distance) << i;
      ASSERT_EQ(feet.inside[k] != 0, is_inside) << i;
      inside += is_inside ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 1000);
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

// A quick no against the distances of all interface triangles.

/// The least distance to a triangle of these labels at v without those two corners.
double least_distance(const TetMesh& mesh, LocalVertex v, const std::array<LocalVertex, 2>& without,
                      const NearTriangle::Wanted& wanted) {
  InterfaceFan fan;
  std::vector<FanTriangle> triangles;
  fan.collect(mesh, v, triangles);
  double least = 1e300;
  for (const FanTriangle& t : triangles) {
    if (t.low != wanted.low || t.high != wanted.high) continue;
    const auto is_left_out = [&](LocalVertex w) { return w == t.a || w == t.b; };
    if (is_left_out(without[0]) || is_left_out(without[1])) continue;
    const DistanceTriangle shape({in_voxels(mesh.position(v)), in_voxels(mesh.position(t.a)),
                                  in_voxels(mesh.position(t.b))});
    least = std::min(least, std::sqrt(shape.squared_distance(wanted.point)));
  }
  return least;
}

TEST(NearTriangle, SaysNoOnlyAndAlwaysWhereAllAreFarther) {
  std::mt19937 random(733);
  NearTriangle near;
  int yes = 0, no = 0;
  for (std::uint32_t i = 0; i < 60 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const TetMesh mesh = dense_mesh(random_volume_of(random, kind, {4, 4, 4}, 2 + i % 4));
    const auto vertex = [&] {
      return static_cast<LocalVertex>(
          below(random, static_cast<std::uint32_t>(mesh.vertex_count())));
    };
    for (int k = 0; k < 300; ++k) {
      const std::array<LocalVertex, 2> without{vertex(), vertex()};
      std::vector<LocalVertex> vertices;
      for (int n = 0; n < 6; ++n) {
        const LocalVertex v = vertex();
        if (v != without[0] && v != without[1] && mesh.is_free(v)) vertices.push_back(v);
      }
      const Label low = below(random, 3);
      const NearTriangle::Wanted wanted{random_point(random), 0.1 + 0.01 * below(random, 150), low,
                                        low + 1 + below(random, 2)};
      double least = 1e300;
      for (const LocalVertex v : vertices) {
        least = std::min(least, least_distance(mesh, v, without, wanted));
      }
      const bool is_near = near.may_be_at(mesh, vertices, without, wanted);
      EXPECT_EQ(is_near, least <= wanted.limit) << least << " of " << wanted.limit;
      ++(is_near ? yes : no);
    }
  }
  EXPECT_GT(yes, 500);
  EXPECT_GT(no, 500);
}

}  // namespace
}  // namespace mw::test
