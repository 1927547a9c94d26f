// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Exact orientation on nearly flat tets, against rational arithmetic.
#include "kernels/audit/orientation.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace mw::audit {
namespace {

using boost::multiprecision::cpp_rational;

int rational_orientation(const std::array<Position, 4>& p) {
  std::array<std::array<cpp_rational, 3>, 3> r;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) r[i][k] = cpp_rational(p[i + 1][k]) - cpp_rational(p[0][k]);
  }
  const cpp_rational det = r[0][0] * r[1][1] * r[2][2] + r[0][1] * r[1][2] * r[2][0] +
                           r[0][2] * r[1][0] * r[2][1] - r[0][2] * r[1][1] * r[2][0] -
                           r[0][0] * r[1][2] * r[2][1] - r[0][1] * r[1][0] * r[2][2];
  return det.sign();
}

void expect_exact(const std::array<Position, 4>& p) {
  const int expected = rational_orientation(p);
  EXPECT_EQ(orientation(p[0], p[1], p[2], p[3]), expected);
  EXPECT_EQ(exact_orientation(p[0], p[1], p[2], p[3]), expected);
  EXPECT_EQ(filtered_orientation(p[0], p[1], p[2], p[3]).value_or(expected), expected);
  EXPECT_EQ(orientation(p[1], p[0], p[2], p[3]), -expected);
}

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Four points of one plane up to rounding, the last one moved by a few units in the last place.
std::array<Position, 4> nearly_flat(std::mt19937_64& random) {
  std::array<Position, 4> p{};
  const double shift = std::ldexp(1, static_cast<int>(random() % 30)) - 1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& x : p[i]) x = uniform(random) + shift;
  }
  const double s = uniform(random), t = uniform(random);
  for (std::size_t k = 0; k < 3; ++k) {
    p[3][k] = p[0][k] + s * (p[1][k] - p[0][k]) + t * (p[2][k] - p[0][k]);
    const double towards = random() % 2 == 0 ? 1e9 : -1e9;
    for (auto steps = random() % 3; steps > 0; --steps) p[3][k] = std::nextafter(p[3][k], towards);
  }
  return p;
}

TEST(Orientation, IsExactOnNearlyFlatTets) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 20000; ++trial) expect_exact(nearly_flat(random));
}

TEST(Orientation, IsExactOnFlatLatticeTets) {
  std::mt19937_64 random(6);
  int flat = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<Position, 4> p{};
    for (Position& point : p) {
      for (double& x : point) x = 0.703125 * static_cast<double>(random() % 4);
    }
    expect_exact(p);
    flat += rational_orientation(p) == 0 ? 1 : 0;
  }
  EXPECT_GT(flat, 1000);
}

TEST(Orientation, IsExactAtTheEndsOfTheRangeOfDouble) {
  std::mt19937_64 random(7);
  const std::array<double, 8> scales{1e-308, 5e-324, 1e-200, 1e-120, 1, 1e90, 1e150, 1e300};
  for (int trial = 0; trial < 5000; ++trial) {
    std::array<Position, 4> p{};
    for (Position& point : p) {
      for (double& x : point) x = (uniform(random) - 0.5) * scales[random() % scales.size()];
    }
    expect_exact(p);
  }
}

TEST(Orientation, PositiveIsVtkPositive) {
  EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orientation({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), -1);
  EXPECT_EQ(exact_orientation({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 0);
}

}  // namespace
}  // namespace mw::audit
