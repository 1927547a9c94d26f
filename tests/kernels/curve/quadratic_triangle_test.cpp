// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Swept volumes against the volumes of many small flat triangles.
#include "kernels/curve/quadratic_triangle.h"

#include <Eigen/Geometry>

#include "tests/testing.h"

namespace mw::test {
namespace {

double number(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

Vec3 point(std::mt19937& random, double size) {
  const double x = number(random), y = number(random), z = number(random);
  return size * Vec3(x, y, z);
}

/// An octahedron whose nodes are off by up to `noise`, edges by as much more.
std::vector<QuadraticTriangle> octahedron(std::mt19937& random, double noise) {
  std::array<Vec3, 6> corners;  // along -x, x, -y, y, -z, z
  for (int i = 0; i < 6; ++i) {
    corners[static_cast<std::size_t>(i)] = Vec3::Unit(i / 2) * (i % 2 == 0 ? -1.0 : 1.0);
  }
  for (Vec3& corner : corners) corner += point(random, noise);
  std::map<std::set<std::size_t>, Vec3> middles;
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto [at, is_new] = middles.try_emplace({a, b}, 0.5 * (corners[a] + corners[b]));
    if (is_new) at->second += point(random, noise);
    return at->second;
  };
  std::vector<QuadraticTriangle> out;
  for (std::size_t octant = 0; octant < 8; ++octant) {
    std::array<std::size_t, 3> c{octant & 1, 2 + (octant >> 1 & 1), 4 + (octant >> 2 & 1)};
    if (std::popcount(octant) % 2 == 0) std::swap(c[1], c[2]);  // outwards
    out.push_back({corners[c[0]], corners[c[1]], corners[c[2]], middle(c[0], c[1]),
                   middle(c[1], c[2]), middle(c[2], c[0])});
  }
  return out;
}

Vec3 on(const QuadraticTriangle& t, double u, double v) {
  const double w = 1 - u - v;
  return w * (2 * w - 1) * t[0] + u * (2 * u - 1) * t[1] + v * (2 * v - 1) * t[2] +
         4 * w * u * t[3] + 4 * u * v * t[4] + 4 * v * w * t[5];
}

/// The volume inside, by `steps` flat triangles along each edge.
double volume(const std::vector<QuadraticTriangle>& surface, int steps) {
  double sum = 0;
  for (const QuadraticTriangle& t : surface) {
    const auto at = [&](int i, int j) {
      return on(t, static_cast<double>(i) / steps, static_cast<double>(j) / steps);
    };
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; i + j < steps; ++j) {
        sum += at(i, j).dot(at(i + 1, j).cross(at(i, j + 1))) / 6;
        if (i + j + 1 == steps) continue;
        sum += at(i + 1, j).dot(at(i + 1, j + 1).cross(at(i, j + 1))) / 6;
      }
    }
  }
  return sum;
}

using Surface = std::vector<QuadraticTriangle>;

double sum_swept(const Surface& from, const Surface& to, decltype(swept_volumes) swept) {
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (const double part : swept(from[i], to[i])) sum += part;
  }
  return sum;
}

TEST(SweptVolumes, OfAClosedSurfaceAreTheDifferenceOfVolumes) {
  std::mt19937 random(1);
  for (int round = 0; round < 30; ++round) {
    const auto from = octahedron(random, 0.1), to = octahedron(random, 0.3);
    // The error of flat triangles falls with the square of the steps.
    const auto limit = [](const auto& surface) {
      return (4 * volume(surface, 32) - volume(surface, 16)) / 3;
    };
    EXPECT_NEAR(sum_swept(from, to, swept_volumes), limit(to) - limit(from), 1e-5) << round;
  }
}

TEST(SweptVolumes, OfStraightPartsAreTheDifferenceOfVolumes) {
  std::mt19937 random(2);
  for (int round = 0; round < 30; ++round) {
    const auto from = octahedron(random, 0.1), to = octahedron(random, 0.3);
    // Two steps along each edge give the straight parts.
    EXPECT_NEAR(sum_swept(from, to, swept_part_volumes), volume(to, 2) - volume(from, 2), 1e-12)
        << round;
  }
}

TEST(SweptVolumes, AreWeightedByHats) {
  const QuadraticTriangle flat{Vec3(0, 0, 0), Vec3(2, 0, 0),   Vec3(0, 3, 0),
                               Vec3(1, 0, 0), Vec3(1, 1.5, 0), Vec3(0, 1.5, 0)};
  QuadraticTriangle lifted = flat;
  for (Vec3& node : lifted) node[2] = 0.5;
  for (const double part : swept_volumes(flat, lifted)) EXPECT_NEAR(part, 3 * 0.5 / 3, 1e-14);
  // The middle of edge 0 1 alone: the integrals of 4 l0 l1 times each hat are 2/15 and 1/15 areas.
  QuadraticTriangle bulged = flat;
  bulged[3][2] = -1;
  const auto parts = swept_volumes(flat, bulged);
  EXPECT_NEAR(parts[0], -3 * 2.0 / 15, 1e-14);
  EXPECT_NEAR(parts[1], -3 * 2.0 / 15, 1e-14);
  EXPECT_NEAR(parts[2], -3 * 1.0 / 15, 1e-14);
  // Three straight parts of four are at that middle, which lies between the corners 0 and 1; each
  // has a third of a quarter of the area there.
  const auto straight = swept_part_volumes(flat, bulged);
  EXPECT_NEAR(straight[0] + straight[1] + straight[2], -3 * 0.25, 1e-14);
  EXPECT_NEAR(straight[0], straight[1], 1e-14);
  EXPECT_LT(std::abs(straight[2]), std::abs(straight[0]));
}

}  // namespace
}  // namespace mw::test
