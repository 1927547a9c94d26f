// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The Jacobian of tets in Bernstein form.
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

}  // namespace mw
