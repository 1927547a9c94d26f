// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets of ten nodes: where they are positive.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "kernels/core/metric.h"

namespace mw {

/// The corners 0 to 3, then the middles of kTetEdges (kernels/core/ten_nodes.h).
using QuadraticTet = std::array<Vec3, 10>;

/// Returns the least of the twenty Bernstein coefficients of the Jacobian, which is a polynomial of
/// degree 3 over the tet; its values are means of the coefficients, so that it is nowhere smaller.
/// Where all edges are straight, with nodes in their middles, each coefficient is six times the
/// volume.
[[nodiscard]] double least_jacobian(const QuadraticTet& nodes);

/// Returns six times the volume of the least of the straight parts kTetParts.
[[nodiscard]] double least_part(const QuadraticTet& nodes);

}  // namespace mw
