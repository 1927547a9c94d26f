// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What short edges cost when a vertex is moved: steps of explicit dynamics are as short as they.
#pragma once

#include <vector>

#include "kernels/quality/star_batch.h"

namespace mw {

/// Edges below this length are lengthened where their stars allow it; the unit is the shortest edge
/// of a voxel (bench/parameters.md, "Constants").
inline constexpr double kShortEdge = 0.85;

/// The cost of short edges at a vertex v, as a share of the shape energy of its star: an edge of
/// length d below kShortEdge costs 15 (1 - d / kShortEdge)^2, and a longer one nothing.
/// Positions are offsets from where v was when its star was collected, in metric units.
class ShortEdges {
 public:
  /// REQUIRES: the star is collected.
  void collect(StarBatch& star);
  [[nodiscard]] double value_at(const Vec3& x) const;
  /// Adds `scale` times the cost's derivatives.  What would make the Hessian indefinite is left
  /// out.
  void add_derivatives(const Vec3& x, double scale, StarTerms& terms) const;

 private:
  std::vector<Vec3> near_;  ///< neighbours that v may come too near to
};

}  // namespace mw
