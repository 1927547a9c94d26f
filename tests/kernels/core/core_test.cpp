// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Boxes of voxels and of labels: what is inside, and where.
#include "kernels/core/label.h"
#include "kernels/core/lanes.h"
#include "kernels/core/lattice.h"
#include "kernels/core/metric.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

TEST(Box3, OffsetsCountUpXFastest) {
  const Box3 box{{-1, 2, 5}, {3, 4, 8}};
  EXPECT_EQ(box.shape(), (Index3{4, 2, 3}));
  EXPECT_EQ(box.voxels(), 24);
  std::int64_t expected = 0;
  for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
    for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
      for (v.x = box.lo.x; v.x < box.hi.x; ++v.x) {
        EXPECT_TRUE(box.contains(v));
        EXPECT_EQ(box.offset(v), expected++);
      }
    }
  }
  for (const Index3 outside :
       {Index3{-2, 2, 5}, {3, 2, 5}, {0, 1, 5}, {0, 4, 5}, {0, 2, 4}, {0, 2, 8}}) {
    EXPECT_FALSE(box.contains(outside));
  }
}

TEST(LabelBox, FindsLabelsByVoxel) {
  LabelBox labels{{{-1, 0, 0}, {1, 2, 2}}, {0, 1, 2, 3, 4, 5, 6, kExterior}};
  EXPECT_EQ(labels.at({-1, 0, 0}), 0U);
  EXPECT_EQ(labels.at({0, 0, 0}), 1U);
  EXPECT_EQ(labels.at({-1, 1, 0}), 2U);
  EXPECT_EQ(labels.at({-1, 0, 1}), 4U);
  EXPECT_EQ(labels.at({0, 1, 1}), kExterior);
}

// Bits of comparisons, one by one and four at a time.

/// Numbers whose k-th is 1 where bit k is set, and 2 elsewhere.
LaneInts ones_at(unsigned bits) {
  const auto at = [bits](unsigned k) { return (bits >> k & 1U) != 0 ? 1 : 2; };
  return LaneInts{at(0), at(1), at(2), at(3)};
}

TEST(Lanes, BitsTellWhereAComparisonHolds) {
  for (unsigned bits = 0; bits < 16; ++bits) EXPECT_EQ(lane_bits(ones_at(bits) == 1), bits);
}

TEST(Lanes, BitsOfFourComparisonsStandSideBySide) {
  for (unsigned bits = 0; bits < 1U << 16; ++bits) {
    const LaneInts a = ones_at(bits & 15U), b = ones_at(bits >> 4 & 15U),
                   c = ones_at(bits >> 8 & 15U), d = ones_at(bits >> 12);
    ASSERT_EQ(lane_bits(a == 1, b == 1, c == 1, d == 1), bits);
  }
}

// Layers of thick slices: near cubes, whatever the spacing.

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

// Exact orientation on the lattice, up to the largest extents.

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

// Lattice to lengths and back under anisotropic spacing.

TEST(Metric, MeasuresInSmallestVoxelEdges) {
  const Metric metric({0.5, 2.0, 0.25});
  const Vec3 v = metric.vector({0, 0, 1024}, {1024, 512, 0});
  EXPECT_EQ(v, Vec3(2.0, 4.0, -1.0));
  EXPECT_EQ(Metric().vector({5, 6, 7}, {5, 6, 7 + 1024}), Vec3(0, 0, 1));
}

TEST(Metric, DoesNotDependOnTheUnitOfSpacing) {
  const Metric a({1, 1, 6}), b({0.25, 0.25, 1.5});
  EXPECT_EQ(a.vector({1, 2, 3}, {400, 500, 600}), b.vector({1, 2, 3}, {400, 500, 600}));
}

TEST(Metric, MovedIsTheInverseOfVector) {
  std::mt19937 random(631);
  for (const auto& spacing : {std::array{1.0, 1.0, 1.0}, {1.0, 1.0, 6.0}, {0.7, 0.3, 0.1}}) {
    const Metric metric(spacing);
    for (int i = 0; i < 1000; ++i) {
      const auto coordinate = [&] { return static_cast<std::int32_t>(random() % 400000); };
      const Point a{coordinate(), coordinate(), coordinate()};
      const Point b{coordinate(), coordinate(), coordinate()};
      ASSERT_EQ(metric.moved(a, metric.vector(a, b)), b);
    }
  }
}

TEST(Metric, MovesToTheNearestLatticePoint) {
  const Metric metric;
  EXPECT_EQ(metric.moved({10, 10, 10}, {0.49 / 1024, -0.49 / 1024, 0.51 / 1024}),
            (Point{10, 10, 11}));
  EXPECT_EQ(metric.moved({10, 10, 10}, {1e30, -1e30, 0}),
            (Point{10 + kMaxTetExtent, 10 - kMaxTetExtent, 10}));
}

/// What a singular matrix gives.
TEST(Metric, WhatIsNotANumberIsClamped) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Metric().moved({10, 10, 10}, {nan, -nan, 0}),
            (Point{10 + kMaxTetExtent, 10 + kMaxTetExtent, 10}));
}

}  // namespace
}  // namespace mw::test
