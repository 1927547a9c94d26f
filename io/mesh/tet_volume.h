// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The volume of a tet in double.
#pragma once

#include "io/mesh/mesh_box.h"

namespace mw::io {

/// Six times the signed volume: positive when d is where the normal of a b c points.
[[nodiscard]] inline double volume6(const Position& a, const Position& b, const Position& c,
                                    const Position& d) {
  std::array<Position, 3> e{};
  for (std::size_t k = 0; k < 3; ++k) {
    e[0][k] = b[k] - a[k];
    e[1][k] = c[k] - a[k];
    e[2][k] = d[k] - a[k];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
         e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

}  // namespace mw::io
