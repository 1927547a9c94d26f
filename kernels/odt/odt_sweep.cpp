// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Moves vertices towards the optimum of their stars.  Circumcentres times volumes need no division.
#include "kernels/odt/codt.h"

#include "kernels/quality/quality.h"
#include "kernels/quality/star_batch.h"

namespace mw {
namespace {

constexpr double kMinStep = 0.1;

/// The way from v to the mean of circumcentres.  With edges a, b, c from v the circumcentre times
/// six-fold volume is half of |a|^2 b x c + |b|^2 c x a + |c|^2 a x b.
Vec3 way_to_optimum(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  Vec3 sum = Vec3::Zero();
  double volume = 0.0;
  for (const LinkTriangle& t : mesh.star(v)) {
    const TetEdges e = tet_edges(metric, mesh.position(v), mesh.position(t.a), mesh.position(t.b),
                                 mesh.position(t.c));
    const Vec3 bc = e.b.cross(e.c);
    sum += e.a.squaredNorm() * bc + e.b.squaredNorm() * e.c.cross(e.a) +
           e.c.squaredNorm() * e.a.cross(e.b);
    volume += e.a.dot(bc);
  }
  return sum / (2.0 * volume);
}

bool may_be_at(const TetMesh& mesh, const Metric& metric, LocalVertex v, Point x, double min) {
  for (const LinkTriangle& t : mesh.star(v)) {
    const Point a = mesh.position(t.a), b = mesh.position(t.b), c = mesh.position(t.c);
    if (volume6(x, a, b, c) <= 0) return false;
    if (min > 0.0 && radius_ratio(tet_edges(metric, x, a, b, c)) < min) return false;
  }
  return true;
}

/// star is scratch.
bool move_vertex(TetMesh& mesh, const Metric& metric, LocalVertex v, double quality_floor,
                 StarBatch& star) {
  const Point start = mesh.position(v);
  const Vec3 way = way_to_optimum(mesh, metric, v);
  star.collect(mesh, metric, v);
  const double min = std::min(quality_floor, star.shape_at(Vec3::Zero()).worst);
  for (double step = 1.0; step > kMinStep; step *= 0.5) {
    const Point x = metric.moved(start, step * way);
    if (x == start) return false;
    if (!may_be_at(mesh, metric, v, x, min)) continue;
    mesh.move(v, x, mesh.quadric(v).shifted(metric.vector(start, x)));
    return true;
  }
  return false;
}

}  // namespace

std::uint64_t odt_sweep(TetMesh& mesh, const Metric& metric, double quality_floor) {
  std::uint64_t moves = 0;
  StarBatch star;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    const bool inner =
        mesh.is_alive(v) && mesh.is_free(v) && mesh.planes(v) == 0 && !mesh.on_interface(v);
    if (inner) moves += move_vertex(mesh, metric, v, quality_floor, star) ? 1U : 0U;
  }
  return moves;
}

}  // namespace mw
