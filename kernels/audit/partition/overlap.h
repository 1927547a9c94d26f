// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Do the tets of a mesh with gaps overlap (promise P2)?
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "kernels/audit/check.h"
#include "kernels/audit/mesh_stars.h"

namespace mw::audit {

/// Where a line along z through a column of voxels goes through a triangle of one tet.
struct LineCrossing {
  std::uint64_t column = 0;  ///< x + y times the volume's width
  double z = 0;              ///< in voxels
  int enters = 0;            ///< tets that begin there, less those that end

  friend bool operator<(const LineCrossing& a, const LineCrossing& b) {
    return std::tie(a.column, a.z, a.enters) < std::tie(b.column, b.z, b.enters);
  }
};

/// Finds all crossings of the triangles that a tile owns.
/// REQUIRES: finite vertices, positive spacing.  Cost: some 24 bytes a crossing.
[[nodiscard]] std::vector<LineCrossing> line_crossings(const MeshStars& stars, const Frame& frame,
                                                       Index3 shape);

/// Makes the check "P2 overlap": on a line along z through each column of voxels, space is in no
/// tet or in one.  As all other triangles have tets on both sides, those of one tet tell how many
/// there are on the way; what is between two that are less than 1e-6 voxel apart is not looked at.
/// This is a sample, no proof: tets that overlap in less than a voxel's width may go unseen.
/// It looks along one line after the other.
class OverlapCheck {
 public:
  explicit OverlapCheck(Index3 shape) : shape_(shape) {}
  /// REQUIRES: crossings are added in ascending order.
  void add(const LineCrossing& crossing);
  /// Judges everything that was added.
  [[nodiscard]] Check verdict();

 private:
  void end_line();

  Index3 shape_;
  Offenders crowded_{"lines along z through two tets at once"};
  std::uint64_t lines_ = 0;
  std::vector<LineCrossing> line_;
};

}  // namespace mw::audit
