// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Layers of thick slices: near cubes, whatever the spacing.
#include "kernels/core/layers.h"

#include <gtest/gtest.h>

#include <random>

namespace mw::test {
namespace {

TEST(Layers, AreTheRoundedRatioToTheSmallestSpacing) {
  EXPECT_EQ(layers_of({1, 1, 1}), (Index3{1, 1, 1}));
  EXPECT_EQ(layers_of({4, 4, 40}), (Index3{1, 1, 10}));
  EXPECT_EQ(layers_of({3, 1, 1}), (Index3{3, 1, 1}));
  EXPECT_EQ(layers_of({0.94, 0.94, 1.5}), (Index3{1, 1, 2}));
  EXPECT_EQ(layers_of({0.586, 0.586, 3.3}), (Index3{1, 1, 6}));
  EXPECT_EQ(layers_of({2, 3, 2.9}), (Index3{1, 2, 1}));
  EXPECT_EQ(layers_of({1e-300, 1, 1e300}), (Index3{1, kMaxLayers, kMaxLayers}));
}

TEST(Layers, LeaveNearCubesOfTheSameBox) {
  std::mt19937 random(711);
  for (int i = 0; i < 2000; ++i) {
    const auto length = [&] { return 0.01 + static_cast<double>(random() % 10000) / 100.0; };
    const std::array<double, 3> spacing{length(), length(), length()};
    const Index3 layers = layers_of(spacing);
    const std::array<double, 3> thin = layered_spacing(spacing, layers);
    const double smallest = *std::min_element(spacing.begin(), spacing.end());
    for (const double s : thin) {
      EXPECT_GE(s, smallest * 2 / 3 * (1 - 1e-12));
      EXPECT_LE(s, smallest * 3 / 2);
    }
    const Index3 shape = layered_shape({5, 6, 7}, layers);
    EXPECT_NEAR(static_cast<double>(shape.x) * thin[0], 5 * spacing[0], 1e-9);
    EXPECT_NEAR(static_cast<double>(shape.y) * thin[1], 6 * spacing[1], 1e-9);
    EXPECT_NEAR(static_cast<double>(shape.z) * thin[2], 7 * spacing[2], 1e-9);
  }
}

}  // namespace
}  // namespace mw::test
