// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sweep of local optimisation over a window: flips, then smoothing.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/distance/distance_guard.h"
#include "kernels/inner/inner_demand.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/surface/surface_energy.h"

namespace mw {

struct OptimiseOptions {
  int sweeps = 1;
  /// Boxes that earlier calls of this march have seen.  The first sweep, and fit_interfaces(),
  /// leave out vertices whose stars lie in one of these boxes, unless their TetMesh::version() has
  /// changed in this window: those calls have treated them.
  std::vector<LatticeBox> earlier;
  /// Boxes that later calls will see.  Sweeps after the first leave out vertices whose stars lie in
  /// one of these boxes: those calls can treat them when more of what is around them is final.
  std::vector<LatticeBox> later;
  /// Boxes that an earlier march has finished.  All sweeps, and fit_interfaces(), leave out
  /// vertices whose stars lie in one of these boxes and that have not changed in this window.
  std::vector<LatticeBox> finished;
  double flip_below = 0.4;     ///< flips are tried on tets with a smaller radius ratio
  double smooth_below = 0.8;   ///< vertices are smoothed whose worst tet has a smaller one
  double quality_floor = 0.1;  ///< no step creates a tet below this, unless it replaces a worse one
  std::optional<SurfaceWeights> surface;  ///< see SmoothOptions
  /// If false, interface vertices that are fitted stay until a later march moves them.  What
  /// fit_interfaces() does before contraction is enough until then and takes 10 to 15 % less time.
  bool moves_fitted = true;
  TetDemands demands;  ///< see SimplifyOptions
};

struct OptimiseStats {
  std::uint64_t flips = 0;
  std::uint64_t moves = 0;

  OptimiseStats& operator+=(const OptimiseStats& other);
};

/// Improves tets in place of the paper's constrained ODT (Sec 5.5).  Every step lowers the shape
/// energy of the tets that it replaces, or, where interfaces are fitted, that and the surface's
/// together; only moves to a flat plane (Smoother) may raise it.  guard is as in simplify().
/// ENSURES: as simplify(): exact positivity, topology and box kept, fixed vertices do not move;
///          flips inside labels keep these as point sets, moves keep them as complexes; the result
///          depends on content only.
OptimiseStats optimise(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                       DistanceGuard* guard = nullptr);

/// Runs one sweep of smoothing over interface vertices alone.  It belongs before contraction, so
/// that what is contracted lies on the surface that the input's faces mean, not on their steps.
/// Without `guard` or options.surface it does nothing.  Returns how many vertices moved.
std::uint64_t fit_interfaces(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                             DistanceGuard* guard);

}  // namespace mw
