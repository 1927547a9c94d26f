// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Quality floor and Eq (3), then exact positivity, over the changed tets of a contraction.
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

/// Calls visit(triangle) for each real tet at v that survives without `other`, until a verdict is
/// not good.
template <typename Visit>
ShapeVerdict each_survivor(const TetMesh& mesh, LocalVertex v, LocalVertex other, Visit visit) {
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior || t.has(other)) continue;
    const ShapeVerdict verdict = visit(t);
    if (verdict != ShapeVerdict::kGood) return verdict;
  }
  return ShapeVerdict::kGood;
}

/// In floating point: rejects most of what is inverted, and all that is badly shaped.
ShapeVerdict shape_at(const TetMesh& mesh, const Metric& metric, LocalVertex v, LocalVertex other,
                      Point x, double floor, const std::optional<double>& variance) {
  return each_survivor(mesh, v, other, [&](const LinkTriangle& t) {
    const TetEdges edges =
        tet_edges(metric, x, mesh.position(t.a), mesh.position(t.b), mesh.position(t.c));
    if (edges.a.dot(edges.b.cross(edges.c)) <= 0.0) return ShapeVerdict::kInverted;
    const bool good =
        reaches_ratio(edges, floor) && (!variance || edge_length_variance(edges) < *variance);
    return good ? ShapeVerdict::kGood : ShapeVerdict::kLowQuality;
  });
}

/// In whole numbers: what counts.
ShapeVerdict sign_at(const TetMesh& mesh, LocalVertex v, LocalVertex other, Point x) {
  return each_survivor(mesh, v, other, [&](const LinkTriangle& t) {
    const Point a = mesh.position(t.a), b = mesh.position(t.b), c = mesh.position(t.c);
    const bool positive = within_extent(x, a) && within_extent(x, b) && within_extent(x, c) &&
                          volume6(x, a, b, c) > 0;
    return positive ? ShapeVerdict::kGood : ShapeVerdict::kInverted;
  });
}

}  // namespace

ShapeFilter::ShapeFilter(const TetMesh& mesh, const Metric& metric, const SimplifyOptions& options)
    : mesh_(mesh), metric_(metric), options_(options), poor_(mesh.vertex_count(), 0) {
  const double floor = options.quality_floor;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    for (const LinkTriangle& t : mesh.star(v)) {
      if (t.label == kExterior || v > t.a || v > t.b || v > t.c) continue;
      const TetEdges edges = tet_edges(metric, mesh.position(v), mesh.position(t.a),
                                       mesh.position(t.b), mesh.position(t.c));
      if (!reaches_ratio(edges, floor)) poor_[v] = poor_[t.a] = poor_[t.b] = poor_[t.c] = 1;
    }
  }
}

double ShapeFilter::floor_for(const Contraction& c) const {
  const bool moves_inner = mesh_.order(c.keep) == 1 || mesh_.order(c.drop) == 1;
  return moves_inner ? std::max(options_.quality_floor, options_.inner_quality)
                     : options_.quality_floor;
}

ShapeVerdict ShapeFilter::judge(const Contraction& c, double floor) const {
  ShapeVerdict verdict =
      shape_at(mesh_, metric_, c.drop, c.keep, c.position, floor, options_.edge_variance);
  if (verdict == ShapeVerdict::kGood && c.moves) {
    verdict = shape_at(mesh_, metric_, c.keep, c.drop, c.position, floor, options_.edge_variance);
  }
  if (verdict == ShapeVerdict::kGood) verdict = sign_at(mesh_, c.drop, c.keep, c.position);
  if (verdict == ShapeVerdict::kGood && c.moves) {
    verdict = sign_at(mesh_, c.keep, c.drop, c.position);
  }
  return verdict;
}

double ShapeFilter::worst_of_star(LocalVertex v) {
  star_.collect(mesh_, metric_, v);
  return star_.shape_at(Vec3::Zero()).worst;
}

ShapeVerdict ShapeFilter::judge(const Contraction& c) {
  const double floor = floor_for(c);
  const ShapeVerdict verdict = judge(c, floor);
  const bool may_be_poor = poor_[c.keep] != 0 || poor_[c.drop] != 0;
  if (verdict != ShapeVerdict::kLowQuality || !may_be_poor) return verdict;
  const double present = std::min(worst_of_star(c.drop), worst_of_star(c.keep));
  if (present >= options_.quality_floor) return verdict;
  const ShapeVerdict again = judge(c, present);
  if (again == ShapeVerdict::kGood) mark_poor(c);
  return again;
}

/// The tets that the contraction leaves may be below the floor.
void ShapeFilter::mark_poor(const Contraction& c) {
  for (LocalVertex v : {c.keep, c.drop}) {
    for (const LinkTriangle& t : mesh_.star(v)) {
      for (LocalVertex w : {t.a, t.b, t.c}) {
        if (w != mesh_.infinity()) poor_[w] = 1;
      }
    }
  }
}

}  // namespace mw
