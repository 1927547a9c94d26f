// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cases 1 to 3 of Sec 5.3.3: survivor, position and cost.
#include "kernels/simplify/contraction.h"

#include <algorithm>
#include <utility>

namespace mw {
namespace {

/// Contractions of Case 2 rarely succeed, so they are tried after others: their cost counts
/// fourfold (bench/parameters.md, "Constants").
constexpr double kInnerToBoundaryFactor = 4.0;

bool is_inner(const TetMesh& mesh, LocalVertex v) {
  return mesh.order(v) == 1;
}

Quadric sum_at(const TetMesh& mesh, const Metric& metric, LocalVertex p, LocalVertex q) {
  const Vec3 from_q_to_p = metric.vector(mesh.position(q), mesh.position(p));
  return mesh.quadric(p) + mesh.quadric(q).shifted(from_q_to_p);
}

/// The place of the least quadric error on the planes that both ends are on.
QuadricMinimum optimum(const TetMesh& mesh, const Metric& metric, LocalVertex p, LocalVertex q) {
  return minimum(sum_at(mesh, metric, p, q), fixed_axes(mesh.planes(p)));
}

/// The lattice point in the middle, rounded towards zero.
Point between(Point a, Point b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

/// Ranks the ends by what must survive, box planes first, then order: positive for p, negative for
/// q, zero for neither.  Nothing when no end satisfies both demands.
std::optional<int> survivor(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
  const unsigned planes_p = mesh.planes(p), planes_q = mesh.planes(q);
  const unsigned both = planes_p & planes_q;
  if (both != planes_p && both != planes_q) return std::nullopt;
  const int by_planes = (both == planes_q ? 1 : 0) - (both == planes_p ? 1 : 0);
  const int by_order =
      (mesh.order(p) > mesh.order(q) ? 1 : 0) - (mesh.order(p) < mesh.order(q) ? 1 : 0);
  if (by_planes * by_order < 0) return std::nullopt;
  return by_planes != 0 ? by_planes : by_order;
}

}  // namespace

std::optional<Contraction> plan_contraction(const TetMesh& mesh, const Metric& metric,
                                            LocalVertex p, LocalVertex q) {
  if (p > q) std::swap(p, q);
  const std::optional<int> rank = survivor(mesh, p, q);
  if (!rank) return std::nullopt;
  Contraction c{.keep = *rank < 0 ? q : p, .drop = *rank < 0 ? p : q};
  if (*rank == 0) {
    // Case 1 (both ends are inner), or Case 3 with ends of the same order: the optimum of the sum.
    const QuadricMinimum best = optimum(mesh, metric, p, q);
    c.position = metric.moved(mesh.position(p), best.offset);
    c.cost = best.value;
    c.moves = c.has_others = true;
    return c;
  }
  // Cases 2 and 3 with ends of different order, or of different box planes: the survivor stays.
  c.position = mesh.position(c.keep);
  const Vec3 way = metric.vector(mesh.position(c.drop), c.position);
  c.cost = mesh.quadric(c.drop).value(way);
  if (is_inner(mesh, c.drop)) {  // Case 2: one end is inner
    c.cost *= kInnerToBoundaryFactor;
  } else {  // Case 3: both ends are on boundaries
    c.cost += mesh.quadric(c.keep).c;
    // An interface does not leave its place for a vertex on the box that is inside one label.
    const int labels = mesh.order(c.drop) - (mesh.planes(c.drop) != 0 ? 1 : 0);
    c.has_others = labels > 1 && mesh.planes(p) == mesh.planes(q);
  }
  return c;
}

std::array<Contraction, 4> other_positions(const TetMesh& mesh, const Metric& metric,
                                           const Contraction& contraction) {
  const Point keep = mesh.position(contraction.keep), drop = mesh.position(contraction.drop);
  const Point middle = between(keep, drop);
  const Quadric sum = sum_at(mesh, metric, contraction.keep, contraction.drop);
  std::array<Point, 4> positions{between(middle, contraction.position), middle, keep, drop};
  if (!contraction.moves) {
    const QuadricMinimum best = optimum(mesh, metric, contraction.keep, contraction.drop);
    const Point place = metric.moved(keep, best.offset);
    positions = {place, between(place, keep), between(place, middle), middle};
  }
  std::array<Contraction, 4> out;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    out[i] = contraction;
    out[i].position = positions[i];
    out[i].cost = sum.value(metric.vector(keep, positions[i]));
    out[i].moves = positions[i] != keep;
  }
  return out;
}

std::vector<Contraction> positions_around(const TetMesh& mesh, const Metric& metric,
                                          const Contraction& contraction) {
  constexpr std::int32_t kStep = kUnitsPerVoxel / 5;
  const Point keep = mesh.position(contraction.keep), drop = mesh.position(contraction.drop);
  const Quadric sum = sum_at(mesh, metric, contraction.keep, contraction.drop);
  const unsigned fixed = fixed_axes(mesh.planes(contraction.keep));
  std::vector<Contraction> out;
  for (const Point& base : {contraction.position, between(keep, drop)}) {
    for_each_index(Box3{{-2, -2, -2}, {3, 3, 3}}, [&](Index3 steps) {
      const auto step = [&](std::int64_t count, unsigned axis) {
        return (fixed >> axis & 1U) != 0 ? 0 : static_cast<std::int32_t>(count) * kStep;
      };
      Contraction other = contraction;
      other.position = {base.x + step(steps.x, 0), base.y + step(steps.y, 1),
                        base.z + step(steps.z, 2)};
      other.cost = sum.value(metric.vector(keep, other.position));
      other.moves = other.position != keep;
      out.push_back(other);
    });
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Contraction& a, const Contraction& b) { return a.cost < b.cost; });
  return out;
}

Quadric contracted_quadric(const TetMesh& mesh, const Metric& metric,
                           const Contraction& contraction) {
  const Vec3 move = metric.vector(mesh.position(contraction.keep), contraction.position);
  const Quadric kept = mesh.quadric(contraction.keep).shifted(move);
  const bool absorbs_inner = is_inner(mesh, contraction.drop) && !is_inner(mesh, contraction.keep);
  if (absorbs_inner) return kept;  // Case 2
  const Vec3 way = metric.vector(mesh.position(contraction.drop), contraction.position);
  return kept + mesh.quadric(contraction.drop).shifted(way);
}

}  // namespace mw
