// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What bends cost.
#include "kernels/surface/bend.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mw::test {
namespace {

double energy_of_degrees(double degrees) {
  return bend_energy(std::cos(degrees * std::numbers::pi / 180.0));
}

TEST(Bend, CostsNothingWhenItIsFlatOrFree) {
  EXPECT_EQ(energy_of_degrees(0.0), 0.0);
  EXPECT_EQ(energy_of_degrees(14.0), 0.0);
  EXPECT_GT(energy_of_degrees(14.2), 0.0);
  EXPECT_NEAR(bend_energy(1.0 - kFreeBend), 0.0, 1e-30);
}

TEST(Bend, CostsMoreTheSharperItIs) {
  for (int degrees = 15; degrees < 180; ++degrees) {
    EXPECT_LT(energy_of_degrees(degrees), energy_of_degrees(degrees + 1)) << degrees;
  }
  EXPECT_NEAR(energy_of_degrees(180.0), 4.0, 0.2);
}

/// No step and no kink where it begins to cost.
TEST(Bend, StartsGently) {
  EXPECT_LT(bend_energy(1.0 - kFreeBend - 1e-4), 2e-8);
}

/// From products of normals of any length, about the bound of what is free too.
TEST(Bend, NeedsNoUnitNormals) {
  for (const double squares : {1e-12, 1.0, 7e9}) {
    for (int i = 0; i <= 20000; ++i) {
      const double cosine = -1.0 + 1e-4 * i;
      EXPECT_NEAR(bend_energy(cosine * std::sqrt(squares), squares), bend_energy(cosine), 1e-13);
    }
  }
  EXPECT_EQ(bend_energy(0.0, 0.0), 0.0);
}

TEST(Bend, CosineIsThatOfDirections) {
  const Vec3 m(0.0, 0.0, 3.0), n(0.0, 5.0, 5.0);
  EXPECT_NEAR(cosine_between(m, n), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(cosine_between(m, -2.0 * m), -1.0, 1e-15);
  EXPECT_EQ(cosine_between(m, Vec3::Zero()), 1.0);
  EXPECT_NEAR(std::acos(kSharpCosine) * 180.0 / std::numbers::pi, 60.0, 1e-9);
}

}  // namespace
}  // namespace mw::test
