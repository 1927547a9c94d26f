// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets of ten nodes, where they are positive; triangles of six nodes, and the volume between two of
// them.
#pragma once

#include <Eigen/Geometry>

#include <array>

#include "kernels/core/metric.h"

namespace mw {

/// The corners 0 to 3, then the middles of kTetEdges (kernels/core/tet_nodes.h).
using QuadraticTet = std::array<Vec3, 10>;

/// Returns the least of the twenty Bernstein coefficients of the Jacobian, which is a polynomial of
/// degree 3 over the tet; its values are means of the coefficients, so that it is nowhere smaller.
/// Where all edges are straight, with nodes in their middles, each coefficient is six times the
/// volume.
[[nodiscard]] double least_jacobian(const QuadraticTet& nodes);

/// Returns six times the volume of the least of the straight parts kTetParts.
[[nodiscard]] double least_part(const QuadraticTet& nodes);

/// The corners 0, 1 and 2, then the middles of the edges 0 1, 1 2 and 2 0.
using QuadraticTriangle = std::array<Vec3, 6>;

/// Returns the signed volume that the surface sweeps over while its nodes go straight from `from`
/// to `to`, weighted by the hat function of each corner; positive where it moves along the normal
/// by the right hand.  The three add up to the volume between the two, sides included, so that sums
/// over a closed surface are the difference of the volumes that it encloses.  They are exact except
/// for rounding, with a quadrature of degree 5 in the triangle (Radon 1948) and Simpson's rule in
/// time.
[[nodiscard]] std::array<double, 3> swept_volumes(const QuadraticTriangle& from,
                                                  const QuadraticTriangle& to);

/// Returns the same for the four straight triangles that the nodes make: one at each corner, and
/// one between the middles.  The volume at a middle belongs to the two corners beside it.
[[nodiscard]] std::array<double, 3> swept_part_volumes(const QuadraticTriangle& from,
                                                       const QuadraticTriangle& to);

}  // namespace mw
