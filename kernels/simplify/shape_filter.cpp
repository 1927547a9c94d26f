// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Exact positivity, quality floor and Eq (3) over the changed tets of a contraction.
#include "kernels/simplify/shape_filter.h"

#include <algorithm>
#include <cstdlib>

#include "kernels/quality/mesh_quality.h"

namespace mw {
namespace {

bool within_extent(Point a, Point b) {
  return std::abs(std::int64_t{a.x} - b.x) < kMaxTetExtent / 2 &&
         std::abs(std::int64_t{a.y} - b.y) < kMaxTetExtent / 2 &&
         std::abs(std::int64_t{a.z} - b.z) < kMaxTetExtent / 2;
}

/// Calls visit(triangle) for each real tet at v that survives without `other`; stops on false.
template <typename Visit>
bool each_survivor(const TetMesh& mesh, LocalVertex v, LocalVertex other, Visit visit) {
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior || t.has(other)) continue;
    if (!visit(t)) return false;
  }
  return true;
}

bool positive_at(const TetMesh& mesh, LocalVertex v, LocalVertex other, Point x) {
  return each_survivor(mesh, v, other, [&](const LinkTriangle& t) {
    const Point a = mesh.position(t.a), b = mesh.position(t.b), c = mesh.position(t.c);
    return within_extent(x, a) && within_extent(x, b) && within_extent(x, c) &&
           volume6(x, a, b, c) > 0;
  });
}

/// True when all survivors reach `floor` from x (and stay below the variance bound).
bool good_at(const TetMesh& mesh, const Metric& metric, LocalVertex v, LocalVertex other, Point x,
             double floor, const std::optional<double>& variance) {
  return each_survivor(mesh, v, other, [&](const LinkTriangle& t) {
    const TetEdges edges =
        tet_edges(metric, x, mesh.position(t.a), mesh.position(t.b), mesh.position(t.c));
    return radius_ratio(edges) >= floor && (!variance || edge_length_variance(edges) < *variance);
  });
}

}  // namespace

ShapeVerdict judge_shape(const TetMesh& mesh, const Metric& metric, const Contraction& c,
                         const SimplifyOptions& options) {
  if (!positive_at(mesh, c.drop, c.keep, c.position) ||
      (c.moves && !positive_at(mesh, c.keep, c.drop, c.position))) {
    return ShapeVerdict::kInverted;
  }
  const auto reaches = [&](double floor) {
    return good_at(mesh, metric, c.drop, c.keep, c.position, floor, options.edge_variance) &&
           (!c.moves ||
            good_at(mesh, metric, c.keep, c.drop, c.position, floor, options.edge_variance));
  };
  const bool moves_inner = mesh.order(c.keep) == 1 || mesh.order(c.drop) == 1;
  const double floor =
      moves_inner ? std::max(options.quality_floor, options.inner_quality) : options.quality_floor;
  if (reaches(floor)) return ShapeVerdict::kGood;
  const double present =
      std::min(worst_of_star(mesh, metric, c.drop), worst_of_star(mesh, metric, c.keep));
  if (present < floor && reaches(present)) return ShapeVerdict::kGood;
  return ShapeVerdict::kLowQuality;
}

}  // namespace mw
