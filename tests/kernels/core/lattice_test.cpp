// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Exact orientation on the lattice, up to the largest extents.
#include "kernels/core/lattice.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace mw::test {
namespace {

__extension__ using Wide = __int128;

/// The determinant from the 4 x 4 matrix of homogeneous coordinates, in 128 bits.
Wide determinant(const std::array<Point, 4>& p) {
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {
    const std::array<Wide, 3> a{p[i].x, p[i].y, p[i].z}, b{p[j].x, p[j].y, p[j].z},
        c{p[k].x, p[k].y, p[k].z};
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  return minor(1, 2, 3) - minor(0, 2, 3) + minor(0, 1, 3) - minor(0, 1, 2);
}

/// Coordinates within kMaxTetExtent of `low`, often at its ends.
Point random_point(std::mt19937& random, std::int32_t low) {
  const auto coordinate = [&] {
    const auto inside = static_cast<std::int32_t>(random() % (kMaxTetExtent + 1));
    const auto choice = random() % 3;
    return low + (choice == 0 ? 0 : choice == 1 ? kMaxTetExtent : inside);
  };
  const auto x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z};
}

TEST(Volume6, IsExactUpToTheLargestExtent) {
  std::mt19937 random(621);
  for (int i = 0; i < 100000; ++i) {
    // Far from the origin too: 2^31 units are 2^21 voxels.
    const std::int32_t low = i % 2 == 0 ? 0 : 2147483647 - kMaxTetExtent;
    std::array<Point, 4> p;
    for (Point& q : p) q = random_point(random, low);
    ASSERT_TRUE(Wide{volume6(p[0], p[1], p[2], p[3])} == determinant(p));
  }
}

TEST(Volume6, ChangesSignWithEverySwap) {
  std::mt19937 random(622);
  for (int i = 0; i < 2000; ++i) {
    std::array<Point, 4> p;
    for (Point& q : p) q = random_point(random, 1000);
    const std::int64_t volume = volume6(p[0], p[1], p[2], p[3]);
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = j + 1; k < 4; ++k) {
        std::array<Point, 4> swapped = p;
        std::swap(swapped[j], swapped[k]);
        ASSERT_EQ(volume6(swapped[0], swapped[1], swapped[2], swapped[3]), -volume);
      }
    }
  }
}

TEST(Volume6, IsPositiveInVtkOrientation) {
  EXPECT_EQ(volume6({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
}

}  // namespace
}  // namespace mw::test
