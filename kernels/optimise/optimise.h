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

/// A box in lattice units, closed.
struct LatticeBox {
  Point lo;
  Point hi;
};

struct OptimiseOptions {
  int sweeps = 1;
  /// What earlier calls of this march have seen.  The first sweep, and fit_interfaces(), leave
  /// vertices alone whose stars lie in one of these boxes and were not changed since this window's
  /// mesh was made: those calls have done it.
  std::vector<LatticeBox> earlier;
  /// What later calls will see.  Sweeps after the first leave vertices alone whose stars lie in one
  /// of these boxes: those calls can do it, when more of what is around is as it will stay.
  std::vector<LatticeBox> later;
  double flip_below = 0.4;     ///< flips are tried on tets with a smaller radius ratio
  double smooth_below = 0.8;   ///< smoothing, at vertices whose worst tet is below
  double quality_floor = 0.1;  ///< no step creates a tet below, unless it replaces a worse one
  std::optional<SurfaceWeights> surface;  ///< as SmoothOptions
  /// False: interface vertices that are fitted stay where they are, for a later march to move. What
  /// fit_interfaces() does before contraction is enough till then, at 10 to 15 % less time.
  bool moves_fitted = true;
  TetDemands demands;  ///< as SimplifyOptions
};

struct OptimiseStats {
  std::uint64_t flips = 0;
  std::uint64_t moves = 0;

  OptimiseStats& operator+=(const OptimiseStats& other);
};

/// Improves tets in place of the paper's constrained ODT (Sec 5.5); every step lowers the shape
/// energy of the tets that it replaces.  guard: as in simplify().
/// ENSURES: as simplify(): exact positivity, labels as point sets kept by flips and as complexes by
///          moves, box kept, fixed vertices do not move; depends on content only.
OptimiseStats optimise(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                       DistanceGuard* guard = nullptr);

/// One sweep of smoothing over interface vertices alone, to be done before contraction: what is
/// contracted then lies on the surface that the input's faces mean, not on their steps.
/// Without `guard` or options.surface it does nothing.  Returns how many moved.
std::uint64_t fit_interfaces(TetMesh& mesh, const Metric& metric, const OptimiseOptions& options,
                             DistanceGuard* guard);

}  // namespace mw
