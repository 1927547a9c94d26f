// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes that triangles of six nodes sweep, by quadrature.
#include "kernels/curve/quadratic.h"

#include <cmath>

namespace mw {
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
