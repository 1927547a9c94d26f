// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which side of the volume's box a triangle lies on.
#include "io/mesh/grouped/box_sides.h"

#include <algorithm>
#include <cmath>

namespace mw::io {
namespace {

constexpr double kTolerance = 1e-9;

/// Of a point along an edge of the box: 0 at its beginning, 1 at its end.
double share_along(const MeshBox& box, std::size_t axis, const Position& p) {
  double along = 0;
  double length = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    along += box.edges[axis][k] * (p[k] - box.origin[k]);
    length += box.edges[axis][k] * box.edges[axis][k];
  }
  return along / length;
}

}  // namespace

Side BoxSides::side_of(const std::array<Position, 3>& corners) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end) {
      const bool on_side = std::all_of(corners.begin(), corners.end(), [&](const Position& p) {
        return std::abs(share_along(box_, axis, p) - static_cast<double>(end)) <= kTolerance;
      });
      if (on_side) return static_cast<Side>(1 + 2 * axis + end);
    }
  }
  return Side::kOuter;
}

}  // namespace mw::io
