// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// New vertices for tets that have none inside their label.
#pragma once

#include "kernels/core/lattice.h"
#include "kernels/distance/carried_samples.h"
#include "kernels/inner/cavity.h"
#include "kernels/inner/inner_demand.h"
#include "kernels/odt/codt.h"

namespace mw {

struct InnerOptions {
  CavityLimits limits;
  /// Boxes that later calls will see.  A tet waits for these calls when the stars of all its
  /// corners lie in one of the boxes, so that a search that fails is made only once.
  std::vector<LatticeBox> later;
  SteinerIds ids;
};

/// Gives tets that a demand names, and that have all corners on interfaces or the box, a vertex
/// inside their label.
///
/// It replaces the tets around one of the edges inside the label, the two at a triangle inside it,
/// the tet and all such neighbours, or the tet alone: whichever is found to leave the best worst
/// radius ratio, if that keeps the limits.  Interfaces stay the same triangles, so labels are the
/// same point sets and carried samples stay valid.  Tets of fixed vertices may be replaced when all
/// tets around are loaded, as flips do.
///
/// A tet that no cavity can help within the limits stays as it is.  Such tets lie in sharp edges
/// and thin parts of a label, and most have neighbours of other labels alone.  (Even a
/// regular tet falls apart into four of radius ratio 0.3.)  With a floor of 0.2 they are a quarter
/// of the tets that lack a vertex on synthetic grains, with one of 0.1 a twentieth.
///
/// REQUIRES: as codt().  ENSURES: as codt(); the result depends on content only.
/// Returns how many vertices are new.
std::uint64_t add_inner_vertices(TetMesh& mesh, CarriedSamples& samples, Point box,
                                 const Metric& metric, const InnerDemand& demand,
                                 const InnerOptions& options);

}  // namespace mw
