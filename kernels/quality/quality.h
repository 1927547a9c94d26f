// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Shape measures of a tetrahedron given by points or by rows of a TetMesh: radius ratio and edge
// length variance (Sec 5.4, Eq (3)).
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

#include "kernels/core/metric.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Three edge vectors of a tetrahedron from one vertex to the other three.
struct TetEdges {
  Vec3 a, b, c;
};

/// Radius ratio 3 r_in / r_circ, in (0, 1]; 1 for the regular tetrahedron.
/// With n1 = b x c, n2 = c x a, n3 = a x b, V6 = a . n1 and w = a^2 n1 + b^2 n2 + c^2 n3:
/// r_in = V6 / sum of the four |n|, r_circ = |w| / (2 V6).
/// ENSURES: a value <= 0 when the orientation is not positive, up to rounding (volume6() is exact).
[[nodiscard]] inline double radius_ratio(const TetEdges& t) {
  const Vec3 n1 = t.b.cross(t.c), n2 = t.c.cross(t.a), n3 = t.a.cross(t.b);
  const double v6 = t.a.dot(n1);
  if (v6 <= 0.0) return v6 < 0.0 ? -1.0 : 0.0;
  const double area = n1.norm() + n2.norm() + n3.norm() + (n1 + n2 + n3).norm();
  const Vec3 w = t.a.squaredNorm() * n1 + t.b.squaredNorm() * n2 + t.c.squaredNorm() * n3;
  return 6.0 * v6 * v6 / (area * w.norm());
}

/// True when radius_ratio(t) >= floor, up to rounding in the last digits; far cheaper, because the
/// sum A of the four |n| lies between the root of their sum of squares and twice that, which
/// decides most cases without a square root.
[[nodiscard]] inline bool reaches_ratio(const TetEdges& t, double floor) {
  constexpr double kRounding = 1e-12;
  const Vec3 n1 = t.b.cross(t.c), n2 = t.c.cross(t.a), n3 = t.a.cross(t.b);
  const double v6 = t.a.dot(n1);
  if (v6 <= 0.0) return false;
  const double q1 = n1.squaredNorm(), q2 = n2.squaredNorm(), q3 = n3.squaredNorm(),
               q4 = (n1 + n2 + n3).squaredNorm();
  const Vec3 w = t.a.squaredNorm() * n1 + t.b.squaredNorm() * n2 + t.c.squaredNorm() * n3;
  // (6 v6^2)^2 >= floor^2 A^2 |w|^2
  const double reached = 36.0 * v6 * v6 * v6 * v6;
  const double wanted = floor * floor * w.squaredNorm() * (1.0 + kRounding);
  const double squares = q1 + q2 + q3 + q4;
  if (reached >= wanted * 4.0 * squares) return true;
  if (reached < wanted * squares) return false;
  const double area = std::sqrt(q1) + std::sqrt(q2) + std::sqrt(q3) + std::sqrt(q4);
  return reached >= wanted * area * area;
}

/// Normalised edge length variance, Eq (3): variance of the six edge lengths over their squared
/// mean.
[[nodiscard]] inline double edge_length_variance(const TetEdges& t) {
  const std::array<double, 6> e{t.a.norm(),         t.b.norm(),         t.c.norm(),
                                (t.b - t.a).norm(), (t.c - t.b).norm(), (t.a - t.c).norm()};
  double sum = 0.0;
  for (double length : e) sum += length;
  const double mean = sum / 6.0;
  double squares = 0.0;
  for (double length : e) squares += (length - mean) * (length - mean);
  return squares / (6.0 * mean * mean);
}

[[nodiscard]] inline TetEdges tet_edges(const Metric& metric, Point v, Point a, Point b, Point c) {
  return {metric.vector(v, a), metric.vector(v, b), metric.vector(v, c)};
}

/// Radius ratio of the tetrahedron that link triangle t spans with a vertex at v.
[[nodiscard]] inline double radius_ratio(const TetMesh& mesh, const Metric& metric, Point v,
                                         const LinkTriangle& t) {
  return radius_ratio(
      tet_edges(metric, v, mesh.position(t.a), mesh.position(t.b), mesh.position(t.c)));
}

[[nodiscard]] inline double radius_ratio(const TetMesh& mesh, const Metric& metric,
                                         const LocalTet& t) {
  return radius_ratio(tet_edges(metric, mesh.position(t.vertices[0]), mesh.position(t.vertices[1]),
                                mesh.position(t.vertices[2]), mesh.position(t.vertices[3])));
}

/// Decides exactly whether the orientation is positive.
[[nodiscard]] inline bool is_positive(const TetMesh& mesh, const LocalTet& t) {
  return volume6(mesh.position(t.vertices[0]), mesh.position(t.vertices[1]),
                 mesh.position(t.vertices[2]), mesh.position(t.vertices[3])) > 0;
}

/// Energy of a tet of radius ratio r, to be minimised as a sum: every tet counts, bad ones most.
/// It is infinite below `min`.  (Raising only a star's worst tet, as max-min optimisation does,
/// leaves the mean radius ratio 0.05 to 0.1 lower at the same mesh size.)
[[nodiscard]] inline double shape_energy(double r, double min) {
  return r > 0.0 && r >= min ? 1.0 / r : std::numeric_limits<double>::infinity();
}

/// Radius ratios down to which an improvement may lower better tets: decent where shapes are all
/// that counts, less where a surface gains.
inline constexpr double kDecentRatio = 0.3;
inline constexpr double kFloorOnSurface = 0.2;

/// The radius ratio that new tets must reach: that of the worst present one (`worst`), or less
/// where both `decent` and the quality floor allow it.
[[nodiscard]] inline double min_allowed(double worst, double decent, double quality_floor) {
  return std::min(worst, std::max(decent, quality_floor));
}

}  // namespace mw
