// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What distances are made of: points and triangles, nearest items, pieces.
#include "kernels/audit/distance/mesh.h"
#include "kernels/audit/distance/trees.h"
#include "tests/kernels/audit/points.h"
#include "tests/oracle/small_volumes.h"

namespace mw::audit {
namespace {

using namespace test;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Smallest value of a convex function on [0, 1].
template <class Function>
double min(Function&& f) {
  double lo = 0;
  double hi = 1;
  for (int step = 0; step < 60; ++step) {
    const double a = lo + (hi - lo) * 0.382;
    const double b = lo + (hi - lo) * 0.618;
    (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
  }
  return std::min({f(0.0), f(1.0), f((lo + hi) / 2)});
}

/// By search along the triangle, without any case: the distance to points linear in (u, u v) is
/// convex, and so is its least value over v.
double searched_distance(const Point& p, const std::array<Point, 3>& t) {
  return min([&](double u) {
    const Point side = along(t[0], t[1], u);
    const Point other = along(t[0], t[2], u);
    return min([&](double v) { return distance(p, along(side, other, v)); });
  });
}

TEST(DistanceParts, ToTrianglesIsThatOfASearch) {
  std::mt19937 random(8);
  const auto coordinate = [&] { return (below(random, 4001) - 2000.0) / 1000; };
  const auto point = [&] { return VoxelPoint{coordinate(), coordinate(), coordinate()}; };
  for (int trial = 0; trial < 2000; ++trial) {
    VoxelTriangle t{point(), point(), point()};
    if (trial % 5 == 1) t[2] = along(t[0], t[1], coordinate());  // flat
    if (trial % 5 == 2) t[2] = t[1];
    if (trial % 5 == 3) t[2] = along(along(t[0], t[1], 0.5), t[2], 1e-7);  // nearly flat
    if (trial % 50 == 4) t[2] = t[1] = t[0];
    const VoxelPoint p = point();
    EXPECT_NEAR(std::sqrt(squared_distance(p, t)), searched_distance(p, t), 1e-6) << trial;
  }
}

TEST(DistanceParts, TreesFindTheNearestItem) {
  std::mt19937 random(9);
  const auto point = [&] {
    return VoxelPoint{below(random, 1000) / 10.0, below(random, 1000) / 10.0,
                      below(random, 1000) / 10.0};
  };
  constexpr Label kLabels = 6;
  for (const std::size_t count : {0U, 1U, 3U, 4U, 5U, 17U, 300U, 2000U}) {
    std::vector<VoxelPoint> items(count);
    std::vector<LabelPair> labels(count);
    for (std::size_t i = 0; i < count; ++i) {
      items[i] = point();
      labels[i] = {below(random, 3), 3 + below(random, 2)};  // none has label 5
    }
    const LabelTrees trees(
        kLabels, count, [&](std::size_t i) { return labels[i]; },
        [&](std::size_t i) {
          return Extent{items[i], items[i]};
        });
    for (Label label = 0; label < kLabels; ++label) {
      const VoxelPoint p = point();
      double expected = kInfinite;
      const auto squared = [&](std::size_t i) {
        return squared_distance(p, Extent{items[i], items[i]});
      };
      for (std::size_t i = 0; i < count; ++i) {
        const bool is_of = labels[i][0] == label || labels[i][1] == label;
        if (is_of) expected = std::min(expected, squared(i));
      }
      EXPECT_EQ(trees.empty(label), expected == kInfinite);
      EXPECT_EQ(trees.nearest(label, p, {}, squared).squared, expected);
    }
  }
}

TEST(DistanceParts, PiecesAreTheTriangle) {
  std::mt19937 random(11);
  const auto coordinate = [&] { return below(random, 30001) / 1000.0; };
  const auto point = [&] { return VoxelPoint{coordinate(), coordinate(), coordinate()}; };
  for (int trial = 0; trial < 100; ++trial) {
    const VoxelTriangle t{point(), point(), point()};
    double sum = 0;
    int pieces = 0;
    for_each_piece(t, kPieceRadius, [&](const VoxelTriangle& piece) {
      sum += area(piece);
      ++pieces;
      EXPECT_LE(radius(piece), kPieceRadius);
      for (const VoxelPoint& p : piece) EXPECT_LE(std::sqrt(squared_distance(p, t)), 1e-9);
    });
    EXPECT_NEAR(sum, area(t), 1e-6);
    PieceEstimates estimates{};
    add_estimates(t, estimates);
    EXPECT_LT(pieces, 4 * estimates[0]);
  }
}

TEST(DistanceParts, PiecesAreBoundedInNumber) {
  const std::vector<InterfaceTriangle> triangles(
      3, {{VoxelPoint{0, 0, 0}, VoxelPoint{1e5, 0, 0}, VoxelPoint{0, 1e5, 0}}, {0, 1}});
  PieceEstimates estimates{};
  EXPECT_EQ(piece_radius(estimates), kPieceRadius);
  for (const InterfaceTriangle& t : triangles) add_estimates(t.corners, estimates);
  const double max = piece_radius(estimates);
  EXPECT_GT(max, kPieceRadius);
  std::uint64_t pieces = 0;
  for (const InterfaceTriangle& t : triangles) {
    for_each_piece(t.corners, max, [&](const VoxelTriangle&) { ++pieces; });
  }
  EXPECT_LE(pieces, 40'000'000U);
}

}  // namespace
}  // namespace mw::audit
