// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nearest point of a triangle: inside, or on the nearest of its edges.
#include "kernels/distance/point_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mw {
namespace {

/// Triangles narrower than this share of their longest edge count as their edges: their normal is
/// noise.
constexpr double kNarrow = 1e-9;

}  // namespace

DistanceTriangle::DistanceTriangle(const std::array<Vec3, 3>& corners)
    : corners_(corners),
      edges_{corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]} {
  const Vec3 normal = edges_[0].cross(edges_[1]);
  const double area = normal.norm();
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double square = edges_[i].squaredNorm();
    inverse_squares_[i] = square > 0.0 ? 1.0 / square : 0.0;
    inward_[i] = normal.cross(edges_[i]);
    longest = std::max(longest, square);
  }
  is_flat_ = area <= kNarrow * longest;
  unit_normal_ = is_flat_ ? Vec3::Zero() : Vec3(normal / area);
}

double DistanceTriangle::squared_distance(const Vec3& p) const {
  const std::array<Vec3, 3> from{p - corners_[0], p - corners_[1], p - corners_[2]};
  if (!is_flat_ && from[0].dot(inward_[0]) >= 0.0 && from[1].dot(inward_[1]) >= 0.0 &&
      from[2].dot(inward_[2]) >= 0.0) {
    const double height = from[0].dot(unit_normal_);
    return height * height;
  }
  const auto to_edge = [&](std::size_t i) {
    const double t = std::clamp(from[i].dot(edges_[i]) * inverse_squares_[i], 0.0, 1.0);
    return (from[i] - t * edges_[i]).squaredNorm();
  };
  return std::min({to_edge(0), to_edge(1), to_edge(2)});
}

}  // namespace mw
