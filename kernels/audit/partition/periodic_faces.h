// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Do opposite sides of the box carry the same triangles (a cell that repeats itself, P2)?
#pragma once

#include <array>
#include <cstdint>

#include "kernels/audit/check.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// What is known of the triangles on the low and the high side of the box along each axis.  Their
/// hashes are summed up, so that parts of a mesh may be looked at apart, in any order.
class FaceTally {
 public:
  struct Side {
    std::uint64_t triangles = 0;
    std::array<std::uint64_t, 2> hashes{};  ///< sums modulo 2^64 of two hashes of each triangle

    friend bool operator==(const Side&, const Side&) = default;
  };

  /// Adds a triangle by the places of its corners in the side's plane, whose order is of no
  /// consequence.
  void add(unsigned axis, bool is_high, std::array<std::array<std::int64_t, 2>, 3> corners);
  void add(const FaceTally& other);
  [[nodiscard]] const std::array<Side, 2>& sides(unsigned axis) const { return sides_[axis]; }

 private:
  std::array<std::array<Side, 2>, 3> sides_{};
};

/// Takes the triangles of a tile on the sides along these axes, a bit for each.  A triangle is
/// counted where its first vertex is owned.  Places are compared in units of 1/4096 voxel.
/// REQUIRES: finite vertices, positive spacing, rows in range.
[[nodiscard]] FaceTally tally_faces(const MeshTile& tile, const Frame& frame, Index3 shape,
                                    unsigned axes);

/// Returns the check "P2 periodic": along each of these axes both sides have the same triangles.
/// Sides that differ pass with a chance of 2^-128.
[[nodiscard]] Check periodic_check(const FaceTally& tally, unsigned axes);

}  // namespace mw::audit
