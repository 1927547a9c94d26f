// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Shape of tetrahedra given by points or by rows of a TetMesh.
#pragma once

#include <algorithm>
#include <limits>

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

/// Decides exactly whether the orientation is positive.
[[nodiscard]] inline bool is_positive(const TetMesh& mesh, const LocalTet& t) {
  return volume6(mesh.position(t.vertices[0]), mesh.position(t.vertices[1]),
                 mesh.position(t.vertices[2]), mesh.position(t.vertices[3])) > 0;
}

/// Energy of a tet of radius ratio r, to be minimised as a sum: every tet counts, bad ones most.
/// It is infinite below `min`.  (Raising only a star's worst tet, as max-min optimisation does,
/// leaves the mean radius ratio 0.05 to 0.1 lower at the same mesh size.)
[[nodiscard]] inline double shape_energy(double r, double min) {
  return r > 0.0 && r >= min ? 1.0 / r : std::numeric_limits<double>::infinity();
}

/// Radius ratios down to which an improvement may lower better tets: decent where shapes are all
/// that counts, less where a surface gains.
inline constexpr double kDecentRatio = 0.3;
inline constexpr double kFloorOnSurface = 0.2;

/// The radius ratio that new tets must reach: that of the worst present one (`worst`), or less
/// where both `decent` and the quality floor allow it.
[[nodiscard]] inline double min_allowed(double worst, double decent, double quality_floor) {
  return std::min(worst, std::max(decent, quality_floor));
}

}  // namespace mw
