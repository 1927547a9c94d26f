// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The vertex moves of optimal Delaunay triangulation.
#pragma once

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Moves each free vertex inside a label, in ascending order, to the mean of the circumcentres of
/// its tets, weighted by volume (Chen and Holst, Efficient mesh optimization schemes based on
/// optimal Delaunay triangulations, 2011).  All other vertices stay, which makes it "constrained".
/// A step that would make a tet non-positive, or the worst tet of the star worse and worse than the
/// floor, is halved up to three times, then left out.
/// ENSURES: as optimise(); returns how many vertices moved.
std::uint64_t odt_sweep(TetMesh& mesh, const Metric& metric, double quality_floor);

}  // namespace mw
