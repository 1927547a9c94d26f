// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What contracting an edge would do: which end survives, where, at which cost (Sec 5.2, 5.3.3).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// A contraction that the types of its ends allow; geometry and topology are still to be tested.
struct Contraction {
  LocalVertex keep = 0;
  LocalVertex drop = 0;
  Point position;           ///< where `keep` goes
  double cost = 0.0;        ///< quadric error, metric units squared
  bool moves = false;       ///< false only if position is that of `keep`
  bool has_others = false;  ///< other_positions() may be good where this place is not
};

/// Plans the contraction of edge (p, q) by the paper's cases.
///  Case 1, both inner: the smaller id survives, at the optimum of Q_p + Q_q.
///  Case 2, one inner: the other survives where it is and keeps its own quadric.  (The paper adds
///           the inner one's, which drags interfaces; kernels/README.md, "Where we deviate from the
///           paper".)  Such contractions rarely succeed, so their cost counts fourfold.
///  Case 3, both on boundaries: the higher order survives where it is; on a tie the smaller id
///           survives, at the optimum.  A survivor that cannot stay may go to other_positions() (in
///           the paper it stays), because voxels put junctions where good tets have no room.
/// Vertices on the box keep to their planes.  The end on more planes survives where it is, unless
/// the other has the higher order.  Ends on the same planes follow the cases within them.  Other
/// pairs are refused.
/// REQUIRES: p, q free.  ENSURES: symmetric in p and q.
[[nodiscard]] std::optional<Contraction> plan_contraction(const TetMesh& mesh, const Metric& metric,
                                                          LocalVertex p, LocalVertex q);

/// Returns other places for the survivor, for when the planned one would leave badly shaped tets
/// (the paper knows no others).  If the plan is the optimum, they are the place half way from it to
/// the middle of the edge, the middle, and the ends; they spare 5 (EM) to 13 % (CT) of the vertices
/// at the same mean radius ratio.  If the survivor stays in the plan, they are the optimum, the
/// places half way from it to the survivor and to the middle, and the middle; they spare 3 (CT) to
/// 9 % (EM) and many of the knots of small triangles (bench/parameters.md).
/// REQUIRES: contraction.has_others.
/// ENSURES: cost is the quadric error of the place, which is on all planes that the ends are on.
[[nodiscard]] std::array<Contraction, 4> other_positions(const TetMesh& mesh, const Metric& metric,
                                                         const Contraction& contraction);

/// Returns places 0.2 and 0.4 voxel around that of a contraction and around the middle of the edge,
/// cheapest first, for edges that should go at any cost.
/// REQUIRES: contraction.has_others.
/// ENSURES: as other_positions().
[[nodiscard]] std::vector<Contraction> positions_around(const TetMesh& mesh, const Metric& metric,
                                                        const Contraction& contraction);

/// The quadric of the surviving vertex, relative to its new position.
[[nodiscard]] Quadric contracted_quadric(const TetMesh& mesh, const Metric& metric,
                                         const Contraction& contraction);

}  // namespace mw
