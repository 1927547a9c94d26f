// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sweeps in ascending vertex order.
#include "kernels/optimise/optimise.h"

#include "kernels/optimise/flips.h"
#include "kernels/optimise/smooth.h"
#include "kernels/quality/mesh_quality.h"

namespace mw {
namespace {

/// Tries every flip of tet (v, t.a, t.b, t.c); true after the first that succeeds.
bool improve_tet(Flipper& flipper, LocalVertex v, const LinkTriangle& t) {
  return flipper.remove_edge(v, t.a) || flipper.remove_edge(v, t.b) ||
         flipper.remove_edge(v, t.c) || flipper.remove_edge(t.a, t.b) ||
         flipper.remove_edge(t.b, t.c) || flipper.remove_edge(t.c, t.a) ||
         flipper.remove_face(v, t.a, t.b, t.c) || flipper.remove_face(t.a, v, t.c, t.b) ||
         flipper.remove_face(t.b, v, t.a, t.c) || flipper.remove_face(t.c, v, t.b, t.a);
}

std::uint64_t flip_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                         DistanceGuard* guard) {
  Flipper flipper(mesh, metric, options.quality_floor, guard);
  std::uint64_t flips = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    for (std::size_t i = 0; i < mesh.star(v).size();) {
      const LinkTriangle t = mesh.star(v)[i];
      const bool mine = v < t.a && v < t.b && v < t.c && t.label != kExterior;
      if (mine && radius_ratio(mesh, metric, mesh.position(v), t) < options.flip_below &&
          improve_tet(flipper, v, t)) {
        ++flips;
        i = 0;
      } else {
        ++i;
      }
    }
  }
  return flips;
}

std::uint64_t smooth_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                           DistanceGuard* guard) {
  std::uint64_t moves = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
    if (worst_of_star(mesh, metric, v) >= options.smooth_below) continue;
    moves += smooth_vertex(mesh, metric, v, options.quality_floor, guard) ? 1U : 0U;
  }
  return moves;
}

}  // namespace

OptimiseStats& OptimiseStats::operator+=(const OptimiseStats& other) {
  flips += other.flips;
  moves += other.moves;
  return *this;
}

OptimiseStats optimise(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                       DistanceGuard* guard) {
  OptimiseStats stats;
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    stats.flips += flip_sweep(mesh, metric, options, guard);
    stats.moves += smooth_sweep(mesh, metric, options, guard);
  }
  return stats;
}

}  // namespace mw
