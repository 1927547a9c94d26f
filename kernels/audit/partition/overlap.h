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

/// A line along z through a column of voxels, where it goes through a triangle of one tet.
struct LineCrossing {
  std::uint64_t column = 0;  ///< x + y times the volume's width
  double z = 0;              ///< voxels
  int enters = 0;            ///< tets that begin there, less those that end

  friend bool operator<(const LineCrossing& a, const LineCrossing& b) {
    return std::tie(a.column, a.z, a.enters) < std::tie(b.column, b.z, b.enters);
  }
};

/// All of the triangles that a tile owns.  REQUIRES: as check_overlap().
[[nodiscard]] std::vector<LineCrossing> line_crossings(const MeshStars& stars, const Frame& frame,
                                                       Index3 shape);

/// Looks along one line after the other.
class OverlapCheck {
 public:
  explicit OverlapCheck(Index3 shape) : shape_(shape) {}
  /// REQUIRES: ascending.
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

/// "P2 overlap": along a line through every column of voxels along z, space is in no tet or in one.
/// Where all other triangles have tets on both sides, only those of one tet tell how many there are
/// on the way; what is between two of them that are less than 1e-6 voxel apart is not looked at.
/// So tets that overlap in less than a voxel's width may go unseen: a sample, no proof.
/// REQUIRES: finite vertices, positive spacing.  Cost: some 24 bytes a line and triangle that meet.
[[nodiscard]] Check check_overlap(const MeshStars& stars, const Frame& frame, Index3 shape);

}  // namespace mw::audit
