// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sweeps in ascending vertex order.
#include "kernels/optimise/optimise.h"

#include "kernels/mesh/failed_pairs.h"
#include "kernels/optimise/flips.h"
#include "kernels/optimise/smooth.h"
#include "kernels/optimise/unfold.h"
#include "kernels/quality/mesh_quality.h"

namespace mw {
namespace {

/// Flips edges, but not one again that failed and did not change since.
class EdgeFlips {
 public:
  EdgeFlips(TetMesh& mesh, const Metric& metric, double quality_floor, DistanceGuard* guard)
      : mesh_(mesh), flipper_(mesh, metric, quality_floor, guard), failed_(mesh.vertex_count()) {}

  /// Tries the edges of tet (v, t.a, t.b, t.c); true after the first flip that succeeds.
  bool improve_tet(LocalVertex v, const LinkTriangle& t) {
    return improve_edge(v, t.a) || improve_edge(v, t.b) || improve_edge(v, t.c) ||
           improve_edge(t.a, t.b) || improve_edge(t.b, t.c) || improve_edge(t.c, t.a);
  }

 private:
  bool improve_edge(LocalVertex p, LocalVertex q) {
    if (failed_.contains(mesh_, p, q)) return false;
    if (flipper_.remove_edge(p, q)) return true;
    failed_.insert(mesh_, p, q);
    return false;
  }

  TetMesh& mesh_;
  Flipper flipper_;
  FailedPairs failed_;
};

std::uint64_t flip_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                         DistanceGuard* guard) {
  EdgeFlips flipper(mesh, metric, options.quality_floor, guard);
  std::uint64_t flips = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    for (std::size_t i = 0; i < mesh.star(v).size();) {
      const LinkTriangle t = mesh.star(v)[i];
      const bool mine = v < t.a && v < t.b && v < t.c && t.label != kExterior;
      if (mine && radius_ratio(mesh, metric, mesh.position(v), t) < options.flip_below &&
          flipper.improve_tet(v, t)) {
        ++flips;
        i = 0;
      } else {
        ++i;
      }
    }
  }
  return flips;
}

std::uint64_t unfold_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                           DistanceGuard& guard) {
  Unfolder unfolder(mesh, metric, *options.surface, options.quality_floor, guard);
  std::uint64_t flips = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) continue;
    flips += unfolder.unfold(v);
  }
  return flips;
}

std::uint64_t smooth_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                           DistanceGuard* guard) {
  Smoother smoother(mesh, metric, {options.smooth_below, options.quality_floor, options.surface},
                    guard);
  std::uint64_t moves = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
    moves += smoother.smooth(v) ? 1U : 0U;
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
    const bool unfolds = guard != nullptr && options.surface && options.surface->bend > 0.0;
    if (unfolds) stats.flips += unfold_sweep(mesh, metric, options, *guard);
    stats.moves += smooth_sweep(mesh, metric, options, guard);
  }
  return stats;
}

std::uint64_t fit_interfaces(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                             DistanceGuard* guard) {
  if (guard == nullptr || !options.surface) return 0;
  // Curvature of steps says nothing, and bends of steps are no faults yet.
  const SurfaceWeights weights{
      .area = 0.3, .junction_area = 0.03, .bend = 0.0, .with_pressure = false};
  Smoother smoother(mesh, metric, {options.smooth_below, options.quality_floor, weights}, guard);
  std::uint64_t moves = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) continue;
    moves += smoother.smooth(v) ? 1U : 0U;
  }
  return moves;
}

}  // namespace mw
