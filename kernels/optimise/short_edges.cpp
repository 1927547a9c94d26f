// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "kernels/optimise/short_edges.h"

namespace mw {
namespace {

/// So heavy that shapes and surface leave no edge far below (bench/parameters.md, "Constants").
constexpr double kWeight = 15.0;
/// Neighbours beyond this distance are not reckoned with: a move seldom goes that far.
constexpr double kReach = 2.0 * kShortEdge;

/// By how much an edge is too short, as a share of what it should have.
double lack(double length) {
  return length < kShortEdge ? 1.0 - length / kShortEdge : 0.0;
}

}  // namespace

void ShortEdges::collect(StarBatch& star) {
  star.find_near(kReach, near_);
}

double ShortEdges::value_at(const Vec3& x) const {
  double sum = 0.0;
  for (const Vec3& other : near_) {
    const double short_by = lack((other - x).norm());
    sum += short_by * short_by;
  }
  return kWeight * sum;
}

void ShortEdges::add_derivatives(const Vec3& x, double scale, StarTerms& terms) const {
  for (const Vec3& other : near_) {
    const Vec3 edge = x - other;
    const double length = edge.norm();
    const double short_by = lack(length);
    if (short_by == 0.0 || length == 0.0) continue;
    const Vec3 way = edge / length;
    const double slope = 2.0 * kWeight * scale / kShortEdge;
    terms.gradient -= slope * short_by * way;
    terms.hessian += slope / kShortEdge * way * way.transpose();
  }
}

}  // namespace mw
