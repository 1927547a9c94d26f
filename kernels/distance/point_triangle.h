// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distance from points to a triangle, and the nearest point of one by its weights at the corners.
#pragma once

#include <array>

#include "kernels/core/lanes.h"
#include "kernels/core/lattice.h"
#include "kernels/core/metric.h"

namespace mw {

/// Exact: units are a power of two to a voxel.
[[nodiscard]] inline Vec3 in_voxels(Point p) {
  return Vec3(p.x, p.y, p.z) / static_cast<double>(kUnitsPerVoxel);
}

/// x, y and z of some points.
using PointLanes = std::array<StoredLanes, 3>;

/// A triangle made ready for many distances; degenerate ones included.
class DistanceTriangle {
 public:
  explicit DistanceTriangle(const std::array<Vec3, 3>& corners);

  [[nodiscard]] const std::array<Vec3, 3>& corners() const { return corners_; }
  /// By the right-hand rule; zero where the triangle is too narrow to have one.
  [[nodiscard]] const Vec3& unit_normal() const { return unit_normal_; }
  /// Squared distance from p to the nearest point of the triangle.
  [[nodiscard]] double squared_distance(const Vec3& p) const;
  /// One bit for each point whose squared distance is at most `squared`.
  [[nodiscard]] unsigned within(const PointLanes& points, double squared) const;
  /// True only when p is farther than `distance` away, and at little cost.
  [[nodiscard]] bool is_beyond(const Vec3& p, double distance) const {
    const double reach = radius_ + distance;
    return (p - corners_[0]).squaredNorm() > reach * reach;
  }

 private:
  std::array<Vec3, 3> corners_;
  std::array<Vec3, 3> edges_;              ///< edge i starts at corner i
  std::array<Vec3, 3> inward_;             ///< across edge i, in the plane
  std::array<double, 3> inverse_squares_;  ///< of the edges' lengths; 0 for none
  Vec3 unit_normal_;
  double radius_ = 0.0;   ///< around the first corner, rounded up
  bool is_flat_ = false;  ///< so narrow that its edges are as near as it gets
};

/// Where a point's foot on a triangle is.
struct Foot {
  std::array<double, 3> weights{};  ///< of the corners, not negative; they add up to 1
  double squared_distance = 0.0;
};

/// The foot of p on the triangle with corners 0, a and b; degenerate ones included.
[[nodiscard]] Foot foot_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b);

/// Feet of some points at once.
struct FeetInside {
  unsigned points = 0;      ///< one bit for each whose foot has positive weights
  StoredLanes at_corner{};  ///< weights of corner 0, of those
};

/// Those on the triangle with corners 0, a and b; none when it is degenerate.
[[nodiscard]] FeetInside feet_inside(const PointLanes& p, const Vec3& a, const Vec3& b);

}  // namespace mw
