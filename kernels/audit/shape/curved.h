// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets of ten nodes whose edges may be curved: whether they are positive, and their shape.
#pragma once

#include "kernels/audit/check.h"
#include "kernels/audit/shape/quality.h"

namespace mw::audit {

/// The corners of a tet, then the middles of kTetEdges (kernels/core/tet_nodes.h).
using TenNodes = std::array<Position, 10>;

/// Returns a lower bound of the least Bernstein coefficient of the Jacobian over six times the
/// volume of the straight tet between the corners.  The Jacobian is nowhere less than the least
/// coefficient.  The bound allows for all rounding; if it is not positive, the tet may be
/// turned over somewhere.  REQUIRES: finite coordinates.
[[nodiscard]] double jacobian_share(const TenNodes& nodes);

/// Returns the volume of a tet less that of its straight parts (kTetParts), each by its absolute
/// volume.  REQUIRES: finite coordinates.
[[nodiscard]] double volume_beyond_parts(const TenNodes& nodes);

/// Returns the nodes of the tet with its last two corners exchanged.
[[nodiscard]] TenNodes mirrored(const TenNodes& nodes);

/// Takes curved tets one after the other.
class CurvedMeter {
 public:
  void add(std::uint64_t tet, const TenNodes& nodes);

  /// Returns the check "P2 Jacobians": each tet's Jacobian is positive everywhere in it.
  [[nodiscard]] Check jacobians() const;
  /// Returns the shape of the straight tets between the corners, which P3 judges.
  [[nodiscard]] const QualityMeter& corners() const { return corners_; }

 private:
  Offenders turned_{"tets whose Jacobian is not positive everywhere"};
  double least_ = 0;
  std::uint64_t worst_ = 0;  ///< the first tet with the least share
  std::uint64_t tets_ = 0;
  QualityMeter corners_;
};

}  // namespace mw::audit
