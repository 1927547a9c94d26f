// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nearest point of a triangle: inside, or on the nearest of its edges.
#include "kernels/distance/point_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mw {
namespace {

/// Triangles narrower than this share of their longest edge count as their edges: their normal is
/// noise, and the edges are as near as it gets.
constexpr double kNarrow = 1e-9;

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double length = way.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(way) / length, 0.0, 1.0) : 0.0;
  return (p - (a + t * way)).squaredNorm();
}

}  // namespace

double squared_distance(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.squaredNorm();
  const double longest = std::max((t[1] - t[0]).squaredNorm(), (t[2] - t[0]).squaredNorm());
  const auto inside_of = [&](std::size_t i, std::size_t j) {
    return (t[j] - t[i]).cross(p - t[i]).dot(normal) >= 0.0;
  };
  if (area > kNarrow * kNarrow * longest * longest && inside_of(0, 1) && inside_of(1, 2) &&
      inside_of(2, 0)) {
    const double height = (p - t[0]).dot(normal);
    return height * height / area;
  }
  return std::min({squared_distance_to_segment(p, t[0], t[1]),
                   squared_distance_to_segment(p, t[1], t[2]),
                   squared_distance_to_segment(p, t[2], t[0])});
}

}  // namespace mw
