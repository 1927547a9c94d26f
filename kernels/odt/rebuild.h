// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The mesh of a window from another list of tets.
#pragma once

#include <span>

#include "kernels/distance/carried_samples.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Makes the mesh anew from `tets`, whose rows are those of the mesh, followed by those of `added`.
/// Vertices that no tet uses are dropped; samples move to the new rows.
/// REQUIRES: box as the mesh was made with; ids of `added` are new; triangles that carry samples
///           still have their tet on the samples' side.
/// ENSURES: canonical order, whatever the order of tets; the same planes are kept (TetMesh).
void rebuild(TetMesh& mesh, CarriedSamples& samples, std::span<const LocalTet> tets,
             std::span<const BlockVertex> added, Point box);

}  // namespace mw
