// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Flips of interface edges that take folds out of interfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/distance/distance_guard.h"
#include "kernels/mesh/failed_pairs.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/optimise/flips.h"
#include "kernels/surface/surface_energy.h"
#include "kernels/surface/surface_star.h"

namespace mw {

/// Flips the edge between two interface triangles where the five edges of the two bend less
/// afterwards.  The tets around the edge may lose in shape, down to the floor, what bends and the
/// distance to the carried faces gain.  A cap (Flipper) of poor shape goes if they do not lose.  A
/// dimple goes where the interface bends less without it.
class Unfolder {
 public:
  // More than five parameters: what a flip is judged by, each kept by another class.
  Unfolder(TetMesh& mesh, const Metric& metric, const SurfaceWeights& weights, double quality_floor,
           DistanceGuard& guard, const TetDemands& demands = {})
      : mesh_(mesh),
        metric_(metric),
        weights_(weights),
        guard_(guard),
        flipper_(mesh, metric, quality_floor, &guard, demands),
        failed_(mesh.vertex_count()) {}

  /// Tries the interface edges at v; returns how many were flipped.  REQUIRES: v free.
  std::uint64_t unfold(LocalVertex v);

 private:
  /// The two triangles at an edge (v, q), and what lies across their other edges.
  struct Hinge;

  /// What lies across from the vertex of a dimple.
  struct Dimple;

  bool unfold_one(LocalVertex v);
  bool unfold_dimple(LocalVertex v);
  [[nodiscard]] Dimple dimple(LocalVertex v);
  bool unfold_hinge(LocalVertex v, const Spoke& spoke);
  [[nodiscard]] bool is_poor_cap(LocalVertex v, const Spoke& spoke) const;
  [[nodiscard]] bool find_open_spokes();
  [[nodiscard]] Hinge hinge(const Spoke& spoke) const;
  template <typename Change>
  [[nodiscard]] double misfit(const SurfaceTriangle& t, const Change& change) const;

  TetMesh& mesh_;
  const Metric& metric_;
  SurfaceWeights weights_;
  DistanceGuard& guard_;
  Flipper flipper_;
  FailedPairs failed_;
  SurfaceStar star_;
  std::vector<Spoke> open_;            ///< spokes that have not failed
  std::vector<std::uint8_t> at_open_;  ///< by triangle, whether it is at one of them
};

}  // namespace mw
