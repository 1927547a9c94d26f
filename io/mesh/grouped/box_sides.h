// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which side of the volume's box a triangle lies on.
#pragma once

#include <array>
#include <cstdint>

#include "io/mesh/mesh_record.h"

namespace mw::io {

/// What a facet bounds.  Sides are named by the axes of the array.
enum class Side : std::uint8_t {
  kInterface,  ///< two labels meet
  kXMin,
  kXMax,
  kYMin,
  kYMax,
  kZMin,
  kZMax,
  kOuter,  ///< not on the box, with one tet: what lies on its other side was left out
};

inline constexpr std::size_t kSides = 8;

/// Returns where a point is along an edge of the box: 0 at its beginning, 1 at its end.
[[nodiscard]] double share_along(const MeshBox& box, std::size_t axis, const Position& p);

/// The six planes of a box.
class BoxSides {
 public:
  explicit BoxSides(const MeshBox& box) : box_(box) {}

  /// Returns the side that all three corners are on, within 1e-9 of the box's length across it (a
  /// lattice point that is on no plane is farther away); kOuter when there is none.
  [[nodiscard]] Side side_of(const std::array<Position, 3>& corners) const;

 private:
  MeshBox box_;
};

}  // namespace mw::io
