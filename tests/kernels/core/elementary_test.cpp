// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Elementary functions against those of the C library, and their bits, which no machine may change.
#include "kernels/core/elementary.h"

#include <cmath>
#include <numbers>

#include "tests/testing.h"

namespace mw::test {
namespace {

constexpr double kError = 1e-15;

/// Places from 1e-12 to 1e12, a thousand to each power of ten.
template <typename Check>
void at_many_places(const Check& check) {
  for (int i = -12000; i <= 12000; ++i) check(std::pow(10.0, i / 1000.0));
}

TEST(Elementary, LogarithmIsNearThatOfTheLibrary) {
  at_many_places([](double x) {
    const long double expected = std::log(static_cast<long double>(x));
    ASSERT_LE(std::abs(logarithm(x) - expected), kError * std::abs(expected)) << x;
  });
  for (const double x : {1 - 1e-9, 1 + 1e-9, 5e-324, 1e308}) {
    EXPECT_NEAR(logarithm(x) / std::log(x), 1, kError) << x;
  }
  EXPECT_EQ(logarithm(1), 0);
}

TEST(Elementary, ExponentialIsNearThatOfTheLibrary) {
  for (int i = -7000; i <= 7000; ++i) {
    const double x = i / 10.0;
    const long double expected = std::exp(static_cast<long double>(x));
    ASSERT_LE(std::abs(exponential(x) - expected), kError * expected) << x;
  }
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-1e300), 0);
  EXPECT_TRUE(std::isinf(exponential(1e300)));
}

TEST(Elementary, PowersAreNearThoseOfTheLibrary) {
  for (const double y : {-2.5, -1.0, 0.0, 2.0 / 3, 3.0}) {
    at_many_places([y](double x) {
      const double expected = std::pow(x, y);
      ASSERT_NEAR(power(x, y) / expected, 1, 1e-13) << x << " " << y;
    });
  }
}

TEST(Elementary, CubeRootOfACubeIsItsEdge) {
  at_many_places([](double x) {
    const long double expected = std::cbrt(static_cast<long double>(x));
    ASSERT_LE(std::abs(cube_root(x) - expected), kError * expected) << x;
  });
  for (const double edge : {0.04, 0.1, 0.3, 0.5, 0.6, 0.7, 1.0, 1.5, 30.0}) {
    EXPECT_EQ(cube_root(edge * edge * edge), edge);
  }
}

TEST(Elementary, AngleIsThatOfTheLibrary) {
  for (const double cosine : {-1e9, -3.0, -1.0, -1e-9, 0.0, 1e-9, 0.2, 1.0, 7.0, 1e9}) {
    at_many_places([cosine](double sine) {
      const double expected = std::atan2(sine, cosine);
      ASSERT_NEAR(angle_of(sine, cosine) / expected, 1, kError) << sine << " " << cosine;
    });
  }
  EXPECT_EQ(angle_of(2, 0), std::numbers::pi / 2);
}

TEST(Elementary, PowersOfTenAreWholeOnes) {
  for (const double x : {1e-300, 1e-5, 0.1, 1.0, 10.0, 1e22, 1e300}) {
    EXPECT_EQ(power_of_ten_below(x), x);
    EXPECT_EQ(power_of_ten_below(9.5 * x), x);
    EXPECT_NEAR(power_of_ten_below(std::nextafter(x, 0.0)) / x, 0.1, kError);
  }
  EXPECT_EQ(power_of_ten_below(0), 0);
}

TEST(Elementary, BitsAreThoseOfEveryMachine) {
  EXPECT_EQ(logarithm(3), 0x1.193ea7aad030bp+0);
  EXPECT_EQ(logarithm(1e-7), -0x1.01e3b843eaa73p+4);
  EXPECT_EQ(exponential(1.5), 0x1.1ed3fe64fc541p+2);
  EXPECT_EQ(exponential(-20.25), 0x1.b93de1e27ca3bp-30);
  EXPECT_EQ(power(0.3, 2.0 / 3), 0x1.cae5562aa4107p-2);
  EXPECT_EQ(cube_root(2), 0x1.428a2f98d728bp+0);
  EXPECT_EQ(angle_of(1, 3), 0x1.4978fa3269ee1p-2);
  EXPECT_EQ(angle_of(2, -1), 0x1.0468a8ace4df6p+1);
}

}  // namespace
}  // namespace mw::test
