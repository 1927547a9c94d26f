// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nearest point of a triangle: inside, or on the nearest of its edges.
#include "kernels/distance/point_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mw {
namespace {

/// A triangle narrower than this share of its longest edge counts as its three edges, because its
/// normal is noise.
constexpr double kNarrow = 1e-9;

/// Corners, edges, inward normals and inverse squares as in DistanceTriangle.
struct Flat {
  const std::array<Vec3, 3>& corners;
  const std::array<Vec3, 3>& edges;
  const std::array<Vec3, 3>& inward;
  const std::array<double, 3>& inverse_squares;
  const Vec3& unit_normal;
};

MW_LANES Lanes to_edge(const Flat& t, std::size_t i, const Lanes3& from) {
  const Lanes3 edge = lanes(t.edges[i]);
  const Lanes zero = lanes(0.0), one = lanes(1.0);
  Lanes share = dot(from, edge) * t.inverse_squares[i];
  share = share < zero ? zero : share;
  share = share > one ? one : share;
  const Lanes3 away = from - share * edge;
  return dot(away, away);
}

MW_WIDE unsigned within_squared(const Flat& t, const PointLanes& points, double squared) {
  const Lanes3 p{load(points[0]), load(points[1]), load(points[2])};
  const Lanes3 a = p - lanes(t.corners[0]), b = p - lanes(t.corners[1]),
               c = p - lanes(t.corners[2]);
  const Lanes height = dot(a, lanes(t.unit_normal));
  const LaneMask inside = (dot(a, lanes(t.inward[0])) >= 0.0) &
                          (dot(b, lanes(t.inward[1])) >= 0.0) & (dot(c, lanes(t.inward[2])) >= 0.0);
  const LaneMask near_edge =
      (to_edge(t, 0, a) <= squared) | (to_edge(t, 1, b) <= squared) | (to_edge(t, 2, c) <= squared);
  const LaneMask near = (inside & (height * height <= squared)) | (~inside & near_edge);
  return lane_bits(__builtin_convertvector(near, LaneInts));
}

/// The share of an edge at which it is nearest to a point.  along is the product of the edge and
/// the vector from its start to the point; square is the edge's squared length.
double share_of_way(double along, double square) {
  return square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
}

/// Finds the feet of four lanes; see foot_on_triangle().
MW_WIDE void find_feet(const PointLanes& points, const Vec3& a, const Vec3& b, FeetInside& out) {
  const double aa = a.squaredNorm(), ab = a.dot(b), bb = b.squaredNorm();
  const double area = aa * bb - ab * ab;
  const Lanes3 p{load(points[0]), load(points[1]), load(points[2])};
  const Lanes pa = dot(p, lanes(a)), pb = dot(p, lanes(b));
  const Lanes u = bb * pa - ab * pb, v = aa * pb - ab * pa, w = area - u - v;
  const LaneMask inside = (u > 0.0) & (v > 0.0) & (w > 0.0);
  const Lanes share = w / area;
  std::memcpy(out.at_corner.data(), &share, sizeof share);
  out.points = lane_bits(__builtin_convertvector(inside, LaneInts));
}

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
  constexpr double kRoundedUp = 1.0 + 1e-9;
  radius_ = kRoundedUp * std::sqrt(std::max(edges_[0].squaredNorm(), edges_[2].squaredNorm()));
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

unsigned DistanceTriangle::within(const PointLanes& points, double squared) const {
  if (!is_flat_) {
    return within_squared({corners_, edges_, inward_, inverse_squares_, unit_normal_}, points,
                          squared);
  }
  unsigned bits = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec3 p(points[0][k], points[1][k], points[2][k]);
    bits |= squared_distance(p) <= squared ? 1U << k : 0U;
  }
  return bits;
}

Foot foot_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double aa = a.squaredNorm(), ab = a.dot(b), bb = b.squaredNorm();
  const double pa = p.dot(a), pb = p.dot(b);
  const double area = aa * bb - ab * ab;  // squared area of the parallelogram
  const double u = bb * pa - ab * pb, v = aa * pb - ab * pa;
  if (area > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= area) {
    const double along_a = u / area, along_b = v / area;
    return {{1.0 - along_a - along_b, along_a, along_b},
            (p - along_a * a - along_b * b).squaredNorm()};
  }
  const Vec3 ab_edge = b - a;
  const double on_a = share_of_way(pa, aa), on_b = share_of_way(pb, bb),
               on_ab = share_of_way((p - a).dot(ab_edge), ab_edge.squaredNorm());
  const std::array<Foot, 3> feet{
      {{{1.0 - on_a, on_a, 0.0}, (p - on_a * a).squaredNorm()},
       {{1.0 - on_b, 0.0, on_b}, (p - on_b * b).squaredNorm()},
       {{0.0, 1.0 - on_ab, on_ab}, (p - a - on_ab * ab_edge).squaredNorm()}}};
  return *std::min_element(feet.begin(), feet.end(), [](const Foot& f, const Foot& g) {
    return f.squared_distance < g.squared_distance;
  });
}

FeetInside feet_inside(const PointLanes& p, const Vec3& a, const Vec3& b) {
  FeetInside out;
  find_feet(p, a, b, out);
  return out;
}

}  // namespace mw
