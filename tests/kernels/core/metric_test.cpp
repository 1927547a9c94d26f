// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lattice to lengths and back under anisotropic spacing.
#include "kernels/core/metric.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace mw::test {
namespace {

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
