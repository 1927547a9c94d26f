// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Radius ratio and Eq (3) against other formulas for the same, and known tets.
#include "kernels/quality/quality.h"

#include <gtest/gtest.h>

#include <random>

namespace mw::test {
namespace {

using Corners = std::array<Vec3, 4>;

double real(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

Corners random_tet(std::mt19937& random) {
  Corners p;
  for (Vec3& v : p) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = real(random);
  }
  if ((p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0])) < 0) std::swap(p[2], p[3]);
  return p;
}

TetEdges edges(const Corners& p) {
  return {p[1] - p[0], p[2] - p[0], p[3] - p[0]};
}

double heron(double a, double b, double c) {
  const double s = (a + b + c) / 2;
  return std::sqrt(s * (s - a) * (s - b) * (s - c));
}

/// 3 r / R from edge lengths: r = 3 V / S with Heron's areas; 6 V R is the area of the triangle
/// whose sides are the products of opposite edges.
double ratio_from_lengths(const Corners& p) {
  const auto length = [&](std::size_t i, std::size_t j) { return (p[i] - p[j]).norm(); };
  const double volume = (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0])) / 6;
  double surface = 0.0;
  for (std::size_t skip = 0; skip < 4; ++skip) {
    const std::size_t i = (skip + 1) % 4, j = (skip + 2) % 4, k = (skip + 3) % 4;
    surface += heron(length(i, j), length(j, k), length(k, i));
  }
  const double products =
      heron(length(0, 1) * length(2, 3), length(0, 2) * length(1, 3), length(0, 3) * length(1, 2));
  return 3.0 * (3.0 * volume / surface) / (products / (6.0 * volume));
}

double variance_from_moments(const Corners& p) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      sum += (p[i] - p[j]).norm();
      squares += (p[i] - p[j]).squaredNorm();
    }
  }
  return 6.0 * squares / (sum * sum) - 1.0;
}

TEST(Sec54Quality, RegularTetIsBest) {
  Corners p{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 1}};
  if (radius_ratio(edges(p)) < 0) std::swap(p[2], p[3]);
  EXPECT_NEAR(radius_ratio(edges(p)), 1.0, 1e-14);
  EXPECT_NEAR(edge_length_variance(edges(p)), 0.0, 1e-14);
}

TEST(Sec54Quality, LatticeCornerTetHasTheValuesOfEq3) {
  const Corners p{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  // Three edges of 1 and three of sqrt 2: variance (sqrt 2 - 1)^2 / 4 over mean (1 + sqrt 2)^2 / 4.
  EXPECT_NEAR(edge_length_variance(edges(p)), 0.0294, 5e-5);
  EXPECT_NEAR(radius_ratio(edges(p)), std::sqrt(3.0) - 1.0, 1e-14);
}

TEST(Sec54Quality, AgreesWithEdgeLengthFormulas) {
  std::mt19937 random(611);
  for (int i = 0; i < 5000; ++i) {
    const Corners p = random_tet(random);
    const double expected = ratio_from_lengths(p);
    if (expected < 1e-4) continue;  // Heron loses digits there
    ASSERT_NEAR(radius_ratio(edges(p)), expected, 1e-9);
    ASSERT_LE(radius_ratio(edges(p)), 1.0 + 1e-12);
    ASSERT_NEAR(edge_length_variance(edges(p)), variance_from_moments(p), 1e-12);
  }
}

TEST(Sec54Quality, DependsOnNeitherScaleNorNaming) {
  std::mt19937 random(612);
  for (int i = 0; i < 500; ++i) {
    const Corners p = random_tet(random);
    const double ratio = radius_ratio(edges(p)), variance = edge_length_variance(edges(p));
    for (double scale : {1e-3, 7.0, 1e6}) {
      const TetEdges e = edges(p);
      const TetEdges scaled{scale * e.a, scale * e.b, scale * e.c};
      ASSERT_NEAR(radius_ratio(scaled), ratio, 1e-12);
      ASSERT_NEAR(edge_length_variance(scaled), variance, 1e-12);
    }
    for (const Corners& even : {Corners{p[1], p[0], p[3], p[2]}, Corners{p[1], p[2], p[0], p[3]},
                                Corners{p[3], p[1], p[0], p[2]}}) {
      ASSERT_NEAR(radius_ratio(edges(even)), ratio, 1e-10);
      ASSERT_NEAR(edge_length_variance(edges(even)), variance, 1e-12);
    }
  }
}

TEST(Sec54Quality, IsNegativeForInvertedAndZeroForFlatTets) {
  std::mt19937 random(613);
  for (int i = 0; i < 500; ++i) {
    const Corners p = random_tet(random);
    EXPECT_GT(radius_ratio(edges(p)), 0.0);
    EXPECT_LT(radius_ratio(edges({p[0], p[2], p[1], p[3]})), 0.0);
  }
  EXPECT_EQ(radius_ratio({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}}), 0.0);
}

/// Fat and flat, large and small.
Corners scaled_tet(std::mt19937& random, int i) {
  Corners p = random_tet(random);
  const double size = std::pow(10.0, i % 7 - 3), flat = std::pow(10.0, -(i % 5));
  for (Vec3& v : p) v = size * Vec3(v[0], v[1], flat * v[2]);
  return p;
}

TEST(Sec54Quality, ReachingARatioIsHavingIt) {
  std::mt19937 random(604);
  int above = 0, below = 0;
  for (int i = 0; i < 20000; ++i) {
    const TetEdges t = edges(scaled_tet(random, i));
    const double ratio = radius_ratio(t);
    for (const double factor : {0.3, 0.9, 1.0 - 1e-9, 1.0 + 1e-9, 1.1, 3.0}) {
      ASSERT_EQ(reaches_ratio(t, ratio * factor), factor < 1.0) << ratio << " * " << factor;
    }
    for (const double floor : {0.05, 0.1, 0.2, 0.3, 0.5}) {
      if (std::abs(ratio - floor) < 1e-9 * floor) continue;
      ASSERT_EQ(reaches_ratio(t, floor), ratio >= floor);
      (ratio >= floor ? above : below) += 1;
    }
  }
  EXPECT_GT(above, 5000);
  EXPECT_GT(below, 5000);
}

TEST(Sec54Quality, InvertedAndFlatTetsReachNoRatio) {
  std::mt19937 random(605);
  for (int i = 0; i < 1000; ++i) {
    Corners p = scaled_tet(random, i);
    std::swap(p[0], p[1]);
    for (const double floor : {0.0, 0.1}) EXPECT_FALSE(reaches_ratio(edges(p), floor));
  }
  const TetEdges flat{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
  EXPECT_FALSE(reaches_ratio(flat, 0.0));
}

}  // namespace
}  // namespace mw::test
