// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distance from points to a triangle, and the nearest point of one by its weights at the corners.
#pragma once

#include <array>

#include "kernels/core/lanes.h"
#include "kernels/core/lattice.h"
#include "kernels/core/metric.h"

namespace mw {

/// The position in voxels; it is exact, as the units of a voxel are a power of two.
[[nodiscard]] inline Vec3 in_voxels(Point p) {
  return Vec3(p.x, p.y, p.z) / static_cast<double>(kUnitsPerVoxel);
}

/// x, y and z of some points.
using PointLanes = std::array<StoredLanes, 3>;

/// A triangle prepared for many distances to it; it may be degenerate.
class DistanceTriangle {
 public:
  explicit DistanceTriangle(const std::array<Vec3, 3>& corners);

  [[nodiscard]] const std::array<Vec3, 3>& corners() const { return corners_; }
  /// The normal by the right-hand rule, or zero where the triangle is too narrow to have one.
  [[nodiscard]] const Vec3& unit_normal() const { return unit_normal_; }
  /// Squared distance from p to the nearest point of the triangle.
  [[nodiscard]] double squared_distance(const Vec3& p) const;
  /// One bit for each point whose squared distance is at most `squared`.
  [[nodiscard]] unsigned within(const PointLanes& points, double squared) const;
  /// A quick test that is true only when p is farther than `distance` away.
  [[nodiscard]] bool is_beyond(const Vec3& p, double distance) const {
    const double reach = radius_ + distance;
    return (p - corners_[0]).squaredNorm() > reach * reach;
  }

 private:
  std::array<Vec3, 3> corners_;
  std::array<Vec3, 3> edges_;              ///< edge i starts at corner i
  std::array<Vec3, 3> inward_;             ///< normal of edge i in the plane, to the inside
  std::array<double, 3> inverse_squares_;  ///< 1 / squared length of edge i; 0 if that is 0
  Vec3 unit_normal_;
  double radius_ = 0.0;   ///< radius of a ball around corner 0 that holds it, rounded up
  bool is_flat_ = false;  ///< so narrow that only distances to its edges count
};

/// A point's foot on a triangle: the nearest point of the triangle.
struct Foot {
  std::array<double, 3> weights{};  ///< weights of the corners, not negative; they add up to 1
  double squared_distance = 0.0;
};

/// The foot of p on the triangle with corners 0, a and b, which may be degenerate.
[[nodiscard]] Foot foot_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b);

/// Products of the corners a and b of a triangle whose third corner is 0.
struct CornerProducts {
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
  double edge = 0.0;  ///< squared length of the edge from a to b
};

[[nodiscard]] inline CornerProducts corner_products(const Vec3& a, const Vec3& b) {
  return {a.squaredNorm(), a.dot(b), b.squaredNorm(), (b - a).squaredNorm()};
}

/// Feet of some points at once.
struct FeetInside {
  unsigned points = 0;      ///< one bit for each point whose foot has positive weights
  StoredLanes at_corner{};  ///< weights of corner 0, where that bit is set
};

/// Feet of four points.
struct FootLanes {
  Lanes at_corner;  ///< weights of corner 0
  Lanes squared_distance;
  LaneMask inside;  ///< all weights are positive
};

/// The share of an edge, from 0 to 1, at which it is nearest to a point.  along holds the points'
/// products with the edge, and square is its squared length.
MW_LANES Lanes share_of_edge(const Lanes& along, double square) {
  if (!(square > 0.0)) return lanes(0.0);
  const Lanes share = along / square, zero = lanes(0.0), one = lanes(1.0);
  const Lanes positive = share < zero ? zero : share;
  return one < positive ? one : positive;
}

/// Finds what foot_on_triangle() finds for each, to the last bit.  `of` is corner_products(a, b).
MW_LANES FootLanes feet_on_triangle(const Lanes3& p, const Vec3& a, const Vec3& b,
                                    const CornerProducts& of) {
  const Lanes3 to_a = lanes(a), to_b = lanes(b), edge = lanes(Vec3(b - a)), from_a = p - to_a;
  const Lanes pa = eigen_dot(p, to_a), pb = eigen_dot(p, to_b);
  const Lanes on_a = share_of_edge(pa, of.aa), on_b = share_of_edge(pb, of.bb),
              on_edge = share_of_edge(eigen_dot(from_a, edge), of.edge);
  const Lanes3 off_a = p - on_a * to_a, off_b = p - on_b * to_b, off_edge = from_a - on_edge * edge;
  const Lanes one = lanes(1.0);
  FootLanes out{one - on_a, eigen_dot(off_a, off_a), LaneMask{}};
  const Lanes by_b = eigen_dot(off_b, off_b), by_edge = eigen_dot(off_edge, off_edge);
  out.at_corner = by_b < out.squared_distance ? one - on_b : out.at_corner;
  out.squared_distance = by_b < out.squared_distance ? by_b : out.squared_distance;
  out.at_corner = by_edge < out.squared_distance ? lanes(0.0) : out.at_corner;
  out.squared_distance = by_edge < out.squared_distance ? by_edge : out.squared_distance;
  const double area = of.aa * of.bb - of.ab * of.ab;
  const Lanes u = of.bb * pa - of.ab * pb, v = of.aa * pb - of.ab * pa;
  const LaneMask within = (u >= 0.0) & (v >= 0.0) & (u + v <= area);
  if (!(area > 0.0) || !any(within)) return out;
  const Lanes along_a = u / area, along_b = v / area, share = one - along_a - along_b;
  const Lanes3 off = p - along_a * to_a - along_b * to_b;
  out.at_corner = within ? share : out.at_corner;
  out.squared_distance = within ? eigen_dot(off, off) : out.squared_distance;
  out.inside = within & (share > 0.0) & (along_a > 0.0) & (along_b > 0.0);
  return out;
}

/// The feet inside the triangle with corners 0, a and b; none when it is degenerate.
[[nodiscard]] FeetInside feet_inside(const PointLanes& p, const Vec3& a, const Vec3& b);

}  // namespace mw
