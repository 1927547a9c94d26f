// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Refuses contractions that fold an interface.
#pragma once

#include "kernels/simplify/contraction.h"
#include "kernels/surface/surface_star.h"

namespace mw {

/// Judges contractions of two boundary vertices by the bend energies (kernels/surface/bend.h) of
/// the interface triangles around: smoothing takes a fold out only where shapes and the distance
/// bound let it, so it is better not made.
class BendFilter {
 public:
  /// Keeps references.
  BendFilter(const TetMesh& mesh, const Metric& metric) : mesh_(mesh), metric_(metric) {}

  /// False when the surviving star would bend by more than most of what both bend now, and what is
  /// free.
  [[nodiscard]] bool stays_smooth(const Contraction& c);

 private:
  void collect(const Contraction& c);

  const TetMesh& mesh_;
  const Metric& metric_;
  SurfaceStar keep_;
  SurfaceStar drop_;
  double present_ = 0.0;  ///< bends of both
  std::uint64_t at_ = 0;  ///< TetMesh::changes(), and 1, when the stars were collected; 0: never
  SurfaceStar merged_;
};

}  // namespace mw
