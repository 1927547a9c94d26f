// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What short edges at a vertex cost, by the definition of ShortEdges.
#pragma once

#include "kernels/optimise/short_edges.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {

/// The cost of the edges at v, were it moved by x.
inline double short_cost(const TetMesh& mesh, const Metric& metric, LocalVertex v,
                         const Vec3& x = Vec3::Zero()) {
  std::set<LocalVertex> others;
  for (const LocalTet& t : mesh.tets()) {
    const bool has = std::ranges::find(t.vertices, v) != t.vertices.end();
    if (has) others.insert(t.vertices.begin(), t.vertices.end());
  }
  others.erase(v);
  double out = 0.0;
  for (const LocalVertex w : others) {
    const double length = (metric.vector(mesh.position(v), mesh.position(w)) - x).norm();
    out += 15.0 * std::pow(std::max(0.0, 1.0 - length / kShortEdge), 2);
  }
  return out;
}

}  // namespace mw::test
