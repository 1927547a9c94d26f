// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A tet is cut into eight by nodes on its edges.
#pragma once

#include <array>
#include <cstddef>

#include "kernels/core/metric.h"

namespace mw {

/// Returns the eight parts of a positive tet by its ten nodes (kernels/core/tet_nodes.h): one at
/// each corner, and four around one of three diagonals between the nodes of opposite edges.  The
/// diagonal is the one whose worst part has the largest radius ratio, of equal ones the first.
/// ENSURES: a triangle is cut alike from both of its sides; where nodes are the exact middles of
/// edges the parts are positive, and those at the corners are like the tet.
[[nodiscard]] std::array<std::array<std::size_t, 4>, 8> halved_tet(
    const std::array<Vec3, 10>& nodes);

/// Returns a radius ratio that the parts of a tet of ratio `floor` or more have.  It is 1.8
/// floor^2, with 0.4 in place of larger floors, rounded down to three digits.
/// It comes from a search for the worst tet, which is no proof: the search found 0.0835 for a floor
/// of 0.2, and 2.1 floor^2 for small ones.
[[nodiscard]] double halved_floor(double floor);
/// Returns the ratio that is left after `times` cuts, one after the other.
[[nodiscard]] double halved_floor(double floor, int times);

}  // namespace mw
