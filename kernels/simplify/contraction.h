// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What contracting an edge would do: which end survives, where, at which cost (Sec 5.2, 5.3.3).
#pragma once

#include <array>
#include <optional>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// A contraction that the types of its ends allow; geometry and topology are still to be tested.
struct Contraction {
  LocalVertex keep = 0;
  LocalVertex drop = 0;
  Point position;           ///< where `keep` goes
  double cost = 0.0;        ///< quadric error, metric units squared
  bool moves = false;       ///< position differs from that of `keep`
  bool has_others = false;  ///< other_positions() may do where this place does not
};

/// Plans the contraction of edge (p, q) by the paper's cases.
///  Case 1, both inner: the smaller id survives, at the optimum of Q_p + Q_q.
///  Case 2, one inner: the other survives where it is.  Its quadric stays its own: the paper adds
///          the inner one, which drags interfaces (kernels/README.md, "Where we deviate from the
///          paper"); such contractions rarely succeed, so their cost counts fourfold.
///  Case 3, both on boundaries: the higher order survives where it is; on a tie the optimum.  Where
///          it cannot stay it may go elsewhere (the paper has it stay): voxels put junctions of
///          labels where no good tets go.
/// Vertices on the box keep to their planes: the end on more planes survives where it is, ends on
/// the same planes go to the optimum within them, other pairs are refused.
/// REQUIRES: p, q free.  ENSURES: symmetric in p and q.
[[nodiscard]] std::optional<Contraction> plan_contraction(const TetMesh& mesh, const Metric& metric,
                                                          LocalVertex p, LocalVertex q);

/// Other places for the survivor, for when the planned one would leave badly shaped tets (the paper
/// knows no others).  Of the optimum: half way to the middle of the edge, the middle, and its ends;
/// they spare 5 (EM) to 13 % (CT) of the vertices at the same mean radius ratio.  Of a place where
/// the survivor is: the optimum, half way to it, half way from there to the middle, and the middle;
/// they spare 3 (CT) to 9 % (EM) and many of the knots of small triangles (bench/parameters.md).
/// REQUIRES: contraction.has_others.
/// ENSURES: cost is the quadric error of the place, which is on all planes that the ends are on.
[[nodiscard]] std::array<Contraction, 4> other_positions(const TetMesh& mesh, const Metric& metric,
                                                         const Contraction& contraction);

/// The quadric of the surviving vertex, relative to its new position.
[[nodiscard]] Quadric contracted_quadric(const TetMesh& mesh, const Metric& metric,
                                         const Contraction& contraction);

}  // namespace mw
