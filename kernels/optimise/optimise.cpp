// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sweeps in ascending vertex order.
#include "kernels/optimise/optimise.h"

#include <algorithm>
#include <array>
#include <span>

#include "kernels/mesh/failed_pairs.h"
#include "kernels/mesh/star_boxes.h"
#include "kernels/optimise/flips.h"
#include "kernels/optimise/smooth.h"
#include "kernels/optimise/unfold.h"
#include "kernels/quality/star_batch.h"

namespace mw {
namespace {

/// The first sweep takes two steps a vertex; later ones start near the minimum and take one
/// (bench/parameters.md, "Constants").
constexpr int kFirstNewtonSteps = 2;

/// Which vertices have a turn in a sweep.
class Turns {
 public:
  /// All vertices except those that earlier calls have treated and that have not changed since.
  static Turns of_first_sweep(const TetMesh& mesh, const OptimiseOptions& options) {
    return Turns(mesh, options, options.earlier,
                 [&](LocalVertex v) { return mesh.version(v) == 0; });
  }
  /// All vertices except those that later calls can treat.
  static Turns of_later_sweeps(const TetMesh& mesh, const OptimiseOptions& options) {
    return Turns(mesh, options, options.later, [](LocalVertex) { return true; });
  }
  [[nodiscard]] bool has(LocalVertex v) const {
    return (has_.empty() || has_[v] != 0) && !finished_.has(v);
  }

 private:
  /// Leaves out vertices that may wait and whose stars lie in a box.
  template <typename MayWait>
  Turns(const TetMesh& mesh, const OptimiseOptions& options, const std::vector<LatticeBox>& boxes,
        MayWait may_wait)
      : finished_(mesh, options.finished) {
    if (boxes.empty()) return;
    has_.assign(mesh.vertex_count(), 1);
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.is_alive(v) && may_wait(v) && star_is_in_one(mesh, v, boxes)) has_[v] = 0;
    }
  }

  FinishedVertices finished_;
  std::vector<std::uint8_t> has_;  ///< empty when none waits
};

/// Flips edges.  One that failed is not tried again until one of its ends changes.
class EdgeFlips {
 public:
  EdgeFlips(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
            DistanceGuard* guard)
      : mesh_(mesh),
        flipper_(mesh, metric, options.quality_floor, guard, options.demands),
        failed_(mesh.vertex_count()) {}

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

/// The tets of which a vertex is the smallest, so that a walk over all vertices meets each once.
class OwnTets {
 public:
  OwnTets(const TetMesh& mesh, const Metric& metric) : mesh_(mesh), metric_(metric) {}

  /// Looks at the next kLanes tets, at most, that are v's own, from row `first` of v's star on.
  /// Returns the rows of those with a radius ratio below `limit`, and puts `first` behind them all.
  std::span<const std::size_t> poor(LocalVertex v, double limit, std::size_t& first) {
    const auto star = mesh_.star(v);
    const Point at = mesh_.position(v);
    std::size_t used = 0;
    for (; used < kLanes && first < star.size(); ++first) {
      const LinkTriangle& t = star[first];
      if (v > t.a || v > t.b || v > t.c || t.label == kExterior) continue;
      group_.set(used, at, mesh_.position(t.a), mesh_.position(t.b), mesh_.position(t.c));
      rows_[used++] = first;
    }
    if (used == 0) return {};
    const StoredLanes ratios = radius_ratios(group_, metric_);
    std::size_t found = 0;
    for (std::size_t k = 0; k < used; ++k) {
      if (ratios[k] < limit) rows_[found++] = rows_[k];
    }
    return {rows_.data(), found};
  }

 private:
  const TetMesh& mesh_;
  const Metric& metric_;
  TetLanes group_;
  std::array<std::size_t, kLanes> rows_{};
};

std::uint64_t flip_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                         DistanceGuard* guard, const Turns& turns) {
  EdgeFlips flipper(mesh, metric, options, guard);
  OwnTets own(mesh, metric);
  std::uint64_t flips = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!turns.has(v)) continue;
    for (std::size_t next = 0; next < mesh.star(v).size();) {
      for (const std::size_t row : own.poor(v, options.flip_below, next)) {
        if (!flipper.improve_tet(v, mesh.star(v)[row])) continue;
        ++flips;
        next = 0;
        break;
      }
    }
  }
  return flips;
}

std::uint64_t unfold_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                           DistanceGuard& guard, const Turns& turns) {
  Unfolder unfolder(mesh, metric, *options.surface, options.quality_floor, guard, options.demands);
  std::uint64_t flips = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!turns.has(v) || !mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) continue;
    flips += unfolder.unfold(v);
  }
  return flips;
}

// More than five parameters: the state of a round, which each sweep uses in its own way.
std::uint64_t smooth_sweep(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                           DistanceGuard* guard, VolumeDebts& debts, const Turns& turns,
                           int newton_steps) {
  Smoother smoother(mesh, metric,
                    {.smooth_below = options.smooth_below,
                     .quality_floor = options.quality_floor,
                     .surface = options.moves_fitted ? options.surface : std::nullopt,
                     .newton_steps = newton_steps,
                     .sizes = options.demands.sizes},
                    guard, &debts);
  const bool leaves_interfaces = guard != nullptr && options.surface && !options.moves_fitted;
  std::uint64_t moves = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!turns.has(v) || !mesh.is_alive(v) || !mesh.is_free(v)) continue;
    if (leaves_interfaces && mesh.on_interface(v)) continue;
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
  VolumeDebts debts;
  Turns turns = Turns::of_first_sweep(mesh, options);
  const bool unfolds = guard != nullptr && options.surface && options.surface->bend > 0.0;
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    if (sweep == 1) turns = Turns::of_later_sweeps(mesh, options);
    stats.flips += flip_sweep(mesh, metric, options, guard, turns);
    if (unfolds) stats.flips += unfold_sweep(mesh, metric, options, *guard, turns);
    const int newton_steps = sweep == 0 ? kFirstNewtonSteps : 1;
    stats.moves += smooth_sweep(mesh, metric, options, guard, debts, turns, newton_steps);
  }
  return stats;
}

std::uint64_t fit_interfaces(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                             DistanceGuard* guard) {
  if (guard == nullptr || !options.surface) return 0;
  // The curvature of steps says nothing, and their bends are no faults at this point
  // (bench/parameters.md, "Constants").
  const SurfaceWeights weights{.fit = 1.25,
                               .junction_fit = 1.25,
                               .area = 0.3,
                               .junction_area = 0.03,
                               .bend = 0.0,
                               .speck = 0.0,
                               .with_pressure = false};
  // One step a visit is enough, because vertices that contraction leaves are visited again.
  Smoother smoother(mesh, metric,
                    {.smooth_below = options.smooth_below,
                     .quality_floor = options.quality_floor,
                     .surface = weights,
                     .newton_steps = 1,
                     .sizes = options.demands.sizes},
                    guard);
  const Turns turns = Turns::of_first_sweep(mesh, options);
  std::uint64_t moves = 0;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!turns.has(v)) continue;
    if (!mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) continue;
    moves += smoother.smooth(v) ? 1U : 0U;
  }
  return moves;
}

}  // namespace mw
