// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Inside by the normal equations of the plane, else the nearest of the three edges.
#include "kernels/surface/foot.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mw {
namespace {

/// Share of the way from `from` to `to` of the point that is nearest to p.
/// along: the product with an edge of this squared length.
double share_of_way(double along, double square) {
  return square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
}

/// Of four lanes; see foot_on_triangle().
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

Foot foot_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double aa = a.squaredNorm(), ab = a.dot(b), bb = b.squaredNorm();
  const double pa = p.dot(a), pb = p.dot(b);
  const double area = aa * bb - ab * ab;  // of the parallelogram, squared
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
