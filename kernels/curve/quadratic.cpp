// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The Jacobian of tets in Bernstein form, and quadrature over triangles of six nodes.
#include "kernels/curve/quadratic.h"

#include <algorithm>
#include <limits>

#include "kernels/core/tet_nodes.h"

namespace mw {
namespace {

/// Bernstein coefficients of a derivative, by the corner that they belong to.
using Slopes = std::array<Vec3, 4>;

/// The control point of an edge, or of a corner where both ends are the same.
Vec3 control_point(const QuadraticTet& nodes, std::size_t i, std::size_t j) {
  if (i == j) return nodes[i];
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    const auto [a, b] = kTetEdges[e];
    if ((a == i && b == j) || (a == j && b == i)) {
      return 2.0 * nodes[4 + e] - 0.5 * (nodes[i] + nodes[j]);
    }
  }
  return nodes[i];
}

/// The derivative towards corner k, 1 to 3, away from corner 0.
Slopes slopes_towards(const QuadraticTet& nodes, std::size_t k) {
  Slopes out;
  for (std::size_t m = 0; m < 4; ++m) {
    out[m] = 2.0 * (control_point(nodes, k, m) - control_point(nodes, 0, m));
  }
  return out;
}

double volume6_of(const QuadraticTet& nodes, const std::array<std::size_t, 4>& part) {
  const Vec3& a = nodes[part[0]];
  return (nodes[part[1]] - a).cross(nodes[part[2]] - a).dot(nodes[part[3]] - a);
}

}  // namespace

double least_jacobian(const QuadraticTet& nodes) {
  const std::array<Slopes, 3> slopes{slopes_towards(nodes, 1), slopes_towards(nodes, 2),
                                     slopes_towards(nodes, 3)};
  // Multiplies three linear forms.  The orders of the same three corners add to one coefficient;
  // sums has what they add, and orders how many there are.
  std::array<double, 64> sums{};
  std::array<int, 64> orders{};
  for (std::size_t m = 0; m < 4; ++m) {
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec3 normal = slopes[0][m].cross(slopes[1][n]);
      for (std::size_t p = 0; p < 4; ++p) {
        std::array<std::size_t, 3> corners{m, n, p};
        std::sort(corners.begin(), corners.end());
        const std::size_t row = 16 * corners[0] + 4 * corners[1] + corners[2];
        sums[row] += normal.dot(slopes[2][p]);
        ++orders[row];
      }
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < sums.size(); ++row) {
    if (orders[row] > 0) least = std::min(least, sums[row] / orders[row]);
  }
  return least;
}

double least_part(const QuadraticTet& nodes) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::array<std::size_t, 4>& part : kTetParts) {
    least = std::min(least, volume6_of(nodes, part));
  }
  return least;
}

namespace {

using Weights = std::array<double, 6>;

/// A point of the triangle, and the shape functions of the six nodes there.
struct QuadraturePoint {
  double weight = 0;             ///< share of the area
  std::array<double, 3> hats{};  ///< barycentric coordinates
  Weights shapes{};
  Weights along1{};  ///< derivatives of the shapes towards corner 1, and towards corner 2
  Weights along2{};
};

QuadraturePoint point_at(double weight, const std::array<double, 3>& hats) {
  const auto [w, u, v] = hats;
  return {
      .weight = weight,
      .hats = hats,
      .shapes = {w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v,
                 4 * v * w},
      .along1 = {1 - 4 * w, 4 * u - 1, 0, 4 * (w - u), 4 * v, -4 * v},
      .along2 = {1 - 4 * w, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)},
  };
}

std::array<QuadraturePoint, 7> radon_points() {
  const double root = std::sqrt(15.0);
  std::array<QuadraturePoint, 7> out;
  out[0] = point_at(0.225, {1.0 / 3, 1.0 / 3, 1.0 / 3});
  for (std::size_t ring = 0; ring < 2; ++ring) {
    const double sign = ring == 0 ? -1 : 1;
    const double share = (6 + sign * root) / 21, weight = (155 + sign * root) / 1200;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<double, 3> hats{share, share, share};
      hats[corner] = 1 - 2 * share;
      out[1 + 3 * ring + corner] = point_at(weight, hats);
    }
  }
  return out;
}

Vec3 sum_of(const Weights& weights, const QuadraticTriangle& nodes) {
  Vec3 out = Vec3::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) out += weights[i] * nodes[i];
  return out;
}

/// Returns the flat triangle between three of the nodes, with its middles.
QuadraticTriangle straight_triangle(const QuadraticTriangle& nodes,
                                    const std::array<std::size_t, 3>& corners) {
  QuadraticTriangle out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = nodes[corners[i]];
    out[3 + i] = 0.5 * (nodes[corners[i]] + nodes[corners[(i + 1) % 3]]);
  }
  return out;
}

}  // namespace

std::array<double, 3> swept_volumes(const QuadraticTriangle& from, const QuadraticTriangle& to) {
  static const std::array<QuadraturePoint, 7> kPoints = radon_points();
  constexpr std::array<double, 3> kSimpson{1.0 / 6, 4.0 / 6, 1.0 / 6};
  QuadraticTriangle move;
  for (std::size_t i = 0; i < move.size(); ++i) move[i] = to[i] - from[i];
  std::array<double, 3> out{};
  for (std::size_t step = 0; step < kSimpson.size(); ++step) {
    QuadraticTriangle now = from;
    for (std::size_t i = 0; i < now.size(); ++i)
      now[i] += 0.5 * static_cast<double>(step) * move[i];
    for (const QuadraturePoint& point : kPoints) {
      const Vec3 normal = sum_of(point.along1, now).cross(sum_of(point.along2, now));
      const double volume =
          0.5 * kSimpson[step] * point.weight * sum_of(point.shapes, move).dot(normal);
      for (std::size_t i = 0; i < 3; ++i) out[i] += volume * point.hats[i];
    }
  }
  return out;
}

std::array<double, 3> swept_part_volumes(const QuadraticTriangle& from,
                                         const QuadraticTriangle& to) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kParts{
      {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  std::array<double, 6> at_nodes{};
  for (const auto& part : kParts) {
    const std::array<double, 3> volumes =
        swept_volumes(straight_triangle(from, part), straight_triangle(to, part));
    for (std::size_t i = 0; i < 3; ++i) at_nodes[part[i]] += volumes[i];
  }
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = at_nodes[i] + 0.5 * (at_nodes[3 + i] + at_nodes[3 + (i + 2) % 3]);
  }
  return out;
}

}  // namespace mw
