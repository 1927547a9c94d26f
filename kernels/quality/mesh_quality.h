// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Shape of tetrahedra given by points or by rows of a TetMesh.
#pragma once

#include "kernels/mesh/tet_mesh.h"
#include "kernels/quality/quality.h"

namespace mw {

[[nodiscard]] inline TetEdges tet_edges(const Metric& metric, Point v, Point a, Point b, Point c) {
  return {metric.vector(v, a), metric.vector(v, b), metric.vector(v, c)};
}

/// Radius ratio of the tetrahedron that link triangle t spans with a vertex at v.
[[nodiscard]] inline double radius_ratio(const TetMesh& mesh, const Metric& metric, Point v,
                                         const LinkTriangle& t) {
  return radius_ratio(
      tet_edges(metric, v, mesh.position(t.a), mesh.position(t.b), mesh.position(t.c)));
}

[[nodiscard]] inline double radius_ratio(const TetMesh& mesh, const Metric& metric,
                                         const LocalTet& t) {
  return radius_ratio(tet_edges(metric, mesh.position(t.vertices[0]), mesh.position(t.vertices[1]),
                                mesh.position(t.vertices[2]), mesh.position(t.vertices[3])));
}

/// Exact.
[[nodiscard]] inline bool is_positive(const TetMesh& mesh, const LocalTet& t) {
  return volume6(mesh.position(t.vertices[0]), mesh.position(t.vertices[1]),
                 mesh.position(t.vertices[2]), mesh.position(t.vertices[3])) > 0;
}

/// Least radius ratio of the real tets at v, were v at x; gives up below `enough`.
[[nodiscard]] inline double worst_at(const TetMesh& mesh, const Metric& metric, LocalVertex v,
                                     Point x, double enough) {
  double worst = 1.0;
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior) continue;
    const double r = radius_ratio(mesh, metric, x, t);
    if (r < worst) worst = r;
    if (worst <= enough) break;
  }
  return worst;
}

}  // namespace mw
