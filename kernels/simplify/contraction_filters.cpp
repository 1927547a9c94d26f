// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Quality floor and Eq (3), then exact positivity, over the changed tets of a contraction.
#include "kernels/simplify/contraction_filters.h"

#include <algorithm>
#include <cstdlib>

#include "kernels/quality/quality.h"

namespace mw {
namespace {

bool within_extent(Point a, Point b) {
  return std::abs(std::int64_t{a.x} - b.x) < kMaxTetExtent / 2 &&
         std::abs(std::int64_t{a.y} - b.y) < kMaxTetExtent / 2 &&
         std::abs(std::int64_t{a.z} - b.z) < kMaxTetExtent / 2;
}

/// Judges tets of any size in whole numbers.
StarVerdict sign_at(const TetMesh& mesh, LocalVertex v, LocalVertex other, Point x) {
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior || t.has(other)) continue;
    const Point a = mesh.position(t.a), b = mesh.position(t.b), c = mesh.position(t.c);
    const bool positive = within_extent(x, a) && within_extent(x, b) && within_extent(x, c) &&
                          volume6(x, a, b, c) > 0;
    if (!positive) return StarVerdict::kInverted;
  }
  return StarVerdict::kGood;
}

/// Tests Eq (3), the paper's filter.
// More than five parameters: a place tried for one end of an edge, and its limit.
StarVerdict variance_at(const TetMesh& mesh, const Metric& metric, LocalVertex v, LocalVertex other,
                        Point x, double max) {
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior || t.has(other)) continue;
    const TetEdges edges =
        tet_edges(metric, x, mesh.position(t.a), mesh.position(t.b), mesh.position(t.c));
    if (edge_length_variance(edges) >= max) return StarVerdict::kLowQuality;
  }
  return StarVerdict::kGood;
}

}  // namespace

ShapeFilter::ShapeFilter(const TetMesh& mesh, const Metric& metric, const SimplifyOptions& options)
    : mesh_(mesh), metric_(metric), options_(options), poor_(mesh.vertex_count(), 0) {
  TetLanes group;
  std::array<std::array<LocalVertex, 4>, kLanes> tets{};
  std::size_t used = 0;
  const auto mark_group = [&] {
    const unsigned below = below_ratio(group, metric, options.quality_floor);
    for (std::size_t k = 0; below != 0 && k < used; ++k) {
      if ((below >> k & 1U) == 0) continue;
      for (const LocalVertex v : tets[k]) poor_[v] = 1;
    }
    used = 0;
  };
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    for (const LinkTriangle& t : mesh.star(v)) {
      if (t.label == kExterior || v > t.a || v > t.b || v > t.c) continue;
      group.set(used, mesh.position(v), mesh.position(t.a), mesh.position(t.b), mesh.position(t.c));
      tets[used++] = {v, t.a, t.b, t.c};
      if (used == kLanes) mark_group();
    }
  }
  mark_group();
}

double ShapeFilter::floor_for(const Contraction& c) const {
  const bool moves_inner = mesh_.order(c.keep) == 1 || mesh_.order(c.drop) == 1;
  return moves_inner ? std::max(options_.quality_floor, options_.inner_quality)
                     : options_.quality_floor;
}

bool ShapeFilter::is_gathered(LocalVertex v) const {
  const std::uint64_t now = mesh_.changes() + 1;
  return std::any_of(gathered_.begin(), gathered_.end(),
                     [&](const Gathered& g) { return g.vertex == v && g.at == now; });
}

/// Returns the star of v.  Keeps that of `other`, because candidates of a vertex share its star.
StarBatch& ShapeFilter::star_of(LocalVertex v, LocalVertex other) {
  const std::uint64_t now = mesh_.changes() + 1;
  for (Gathered& g : gathered_) {
    if (g.vertex == v && g.at == now) return g.star;
  }
  const bool first_is_other = gathered_[0].vertex == other && gathered_[0].at == now;
  Gathered& g = gathered_[first_is_other ? 1 : 0];
  g.vertex = v;
  g.at = now;
  g.star.collect(mesh_, metric_, v);
  return g.star;
}

/// Judges in whole numbers, which is the verdict that counts.
StarVerdict ShapeFilter::judge_signs(LocalVertex v, LocalVertex other, Point x) {
  const Point from = mesh_.position(v);
  const Point offset{x.x - from.x, x.y - from.y, x.z - from.z};
  const ExactSigns signs = star_of(v, other).signs_at(offset, other);
  if (signs == ExactSigns::kUnknown) return sign_at(mesh_, v, other, x);
  return signs == ExactSigns::kPositive ? StarVerdict::kGood : StarVerdict::kInverted;
}

/// Judges in floating point, which rejects most inverted tets and all that are badly shaped.
StarVerdict ShapeFilter::judge_shape(LocalVertex v, LocalVertex other, Point x, double floor) {
  const Vec3 offset = metric_.vector(mesh_.position(v), x);
  const StarVerdict verdict = star_of(v, other).judge_at(offset, other, floor);
  if (verdict != StarVerdict::kGood || !options_.edge_variance) return verdict;
  return variance_at(mesh_, metric_, v, other, x, *options_.edge_variance);
}

StarVerdict ShapeFilter::judge(const Contraction& c, double floor) {
  const auto all = [&](auto judge_star) {
    // A star that is gathered comes first, because a refusal there spares the other.
    const bool keep_first = c.moves && is_gathered(c.keep);
    const LocalVertex first = keep_first ? c.keep : c.drop, second = keep_first ? c.drop : c.keep;
    const StarVerdict verdict = judge_star(first, second);
    return verdict == StarVerdict::kGood && c.moves ? judge_star(second, first) : verdict;
  };
  const StarVerdict shape =
      all([&](LocalVertex v, LocalVertex w) { return judge_shape(v, w, c.position, floor); });
  if (shape != StarVerdict::kGood) return shape;
  return all([&](LocalVertex v, LocalVertex w) { return judge_signs(v, w, c.position); });
}

StarVerdict ShapeFilter::judge(const Contraction& c) {
  const double floor = floor_for(c);
  const StarVerdict verdict = judge(c, floor);
  const bool may_be_poor = poor_[c.keep] != 0 || poor_[c.drop] != 0;
  if (verdict != StarVerdict::kLowQuality || !may_be_poor) return verdict;
  const auto worst = [&](LocalVertex v, LocalVertex w) {
    return star_of(v, w).shape_at(Vec3::Zero()).worst;
  };
  const double present = std::min(worst(c.drop, c.keep), worst(c.keep, c.drop));
  if (present >= options_.quality_floor) return verdict;
  const StarVerdict again = judge(c, present);
  if (again == StarVerdict::kGood) mark_poor(c);
  return again;
}

/// Marks all vertices of the tets that the contraction leaves, which may be below the floor.
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
