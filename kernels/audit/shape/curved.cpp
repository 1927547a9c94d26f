// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Coefficients of Jacobians by polarisation.
#include "kernels/audit/shape/curved.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/core/tet_nodes.h"
#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

using Barycentric = std::array<double, 4>;

/// The derivative of the tet's map towards corner k, away from corner 0, at a point.
Position slope_at(const TenNodes& nodes, const Barycentric& at, std::size_t k) {
  // Derivatives of a corner's function l (2 l - 1) and of an edge's 4 l m.
  const auto towards = [&](std::size_t corner) {
    Position out{};
    const auto add = [&](const Position& p, double factor) {
      for (std::size_t i = 0; i < 3; ++i) out[i] += factor * p[i];
    };
    add(nodes[corner], 4 * at[corner] - 1);
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const auto [a, b] = kTetEdges[e];
      if (a == corner) add(nodes[4 + e], 4 * at[b]);
      if (b == corner) add(nodes[4 + e], 4 * at[a]);
    }
    return out;
  };
  return minus(towards(k), towards(0));
}

/// Coefficients of the Jacobian, and what they can be off by.
struct Coefficients {
  std::array<double, 20> values{};
  double rounding = 0;
};

Coefficients coefficients_of(const TenNodes& given) {
  // Positions are relative to a corner, so that only the size of the tet counts for rounding.
  TenNodes nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = minus(given[i], given[0]);
  std::array<std::array<Position, 3>, 4> slopes;  // at each corner, linear in between
  double longest = 0;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    Barycentric at{};
    at[corner] = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      slopes[corner][k] = slope_at(nodes, at, k + 1);
      longest = std::max(longest, norm(slopes[corner][k]));
    }
  }
  // A coefficient is the Jacobian's polar form at three corners: the mean over the ways to give
  // each of the three slopes one of these corners.
  Coefficients out;
  std::size_t row = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a; b < 4; ++b) {
      for (std::size_t c = b; c < 4; ++c) {
        const std::array<std::array<std::size_t, 3>, 6> ways{
            {{a, b, c}, {a, c, b}, {b, a, c}, {b, c, a}, {c, a, b}, {c, b, a}}};
        for (const auto& way : ways) {
          out.values[row] += determinant(slopes[way[0]][0], slopes[way[1]][1], slopes[way[2]][2]);
        }
        out.values[row++] /= 6;
      }
    }
  }
  // A slope is a sum of some ten products, a determinant has six of three slopes: some fifty
  // roundings of numbers that no product of three lengths exceeds.
  out.rounding = 1000 * std::numeric_limits<double>::epsilon() * longest * longest * longest;
  return out;
}

}  // namespace

double jacobian_share(const TenNodes& nodes) {
  const Coefficients found = coefficients_of(nodes);
  const double straight = volume6(nodes[0], nodes[1], nodes[2], nodes[3]);
  if (!(straight > found.rounding)) return 0;
  const double least = *std::min_element(found.values.begin(), found.values.end());
  return (least - found.rounding) / straight;
}

double volume_beyond_parts(const TenNodes& nodes) {
  // The integral of each Bernstein polynomial is the same share of the volume.
  const Coefficients found = coefficients_of(nodes);
  double out = 0;
  for (const double value : found.values) out += value / static_cast<double>(found.values.size());
  for (const auto& [a, b, c, d] : kTetParts) {
    out -= std::abs(volume6(nodes[a], nodes[b], nodes[c], nodes[d]));
  }
  return out / 6;
}

TenNodes mirrored(const TenNodes& nodes) {
  return {nodes[0], nodes[1], nodes[3], nodes[2], nodes[4],
          nodes[8], nodes[7], nodes[6], nodes[5], nodes[9]};
}

void CurvedMeter::add(std::uint64_t tet, const TenNodes& nodes) {
  const double share = jacobian_share(nodes);
  if (!(share > 0)) turned_.add([tet] { return std::to_string(tet); });
  if (tets_++ == 0 || share < least_) {
    least_ = share;
    worst_ = tet;
  }
  const NumberedTet straight{tet, {nodes[0], nodes[1], nodes[2], nodes[3]}};
  corners_.add({&straight, 1});
}

Check CurvedMeter::jacobians() const {
  const std::string detail = turned_.text() + " of " + std::to_string(tets_) + ", least share of " +
                             "the straight tet's " + number(least_) + " (tet " +
                             std::to_string(worst_) + ")";
  return {"P2 Jacobians", turned_.count() == 0, detail};
}

}  // namespace mw::audit
