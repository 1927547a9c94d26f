// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A few tets of one label, to be replaced by those around a new vertex among them.
#pragma once

#include <optional>
#include <vector>

#include "kernels/mesh/tet_mesh.h"
#include "kernels/size/size_field.h"

namespace mw {

/// Where a new vertex would go, and the worst radius ratio that it leaves.
struct CavityPosition {
  Point position;
  double worst = 0.0;
};

/// What is asked of the new tets.
struct CavityLimits {
  double min_ratio = 0.0;
  const SizeField* sizes = nullptr;  ///< limits of new edges, as of moves; null means none
};

/// Tets of one label whose union is a ball with all their vertices on its surface.
class Cavity {
 public:
  Cavity(const TetMesh& mesh, const Metric& metric, std::vector<LocalTet> tets);

  [[nodiscard]] const std::vector<LocalTet>& tets() const { return tets_; }
  /// The tets between a vertex and the surface.  If all are positive, they cover the same points,
  /// once, as old and new ones have one boundary.
  [[nodiscard]] std::vector<LocalTet> tets_around(LocalVertex row) const;

  /// The better place of `start` and the middle of the corners; nothing when at both some new tet
  /// would not be exactly positive.
  [[nodiscard]] std::optional<CavityPosition> first_position(Point start) const;
  /// The best place that a search from `first` finds; nothing when that breaks the limits.
  /// Cost: some 25 looks at the surface.
  [[nodiscard]] std::optional<CavityPosition> best_position(CavityPosition first,
                                                            const CavityLimits& limits) const;

 private:
  void find_surface();
  [[nodiscard]] Point middle() const;
  /// The worst radius ratio with the vertex at x.  May stop at one below `enough`; at most 0 when a
  /// tet would not be exactly positive.
  [[nodiscard]] double worst_at(Point x, double enough) const;
  [[nodiscard]] bool keeps_lengths(Point x, const SizeField& sizes) const;
  void search(CavityPosition& best) const;

  const TetMesh& mesh_;
  const Metric& metric_;
  std::vector<LocalTet> tets_;
  std::vector<LinkTriangle> surface_;  ///< positive with a vertex inside
};

}  // namespace mw
