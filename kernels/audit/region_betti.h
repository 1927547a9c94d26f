// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers of labels in a mesh that has gaps: from the tets of each label alone.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/audit/betti.h"

namespace mw::audit {

/// As mesh_betti(), without its last row (the exterior) and without asking what is outside of a
/// label's tets: other labels, the exterior, or space without tets (labels that were left out).
/// Components and Euler characteristics are counted.  Cavities follow from boundaries, because in
/// the 3-sphere
///   of a part (open, connected), the complement has as many components as its boundary;
///   of a connected closed region, it has as many as there are boundaries seen from outside, where
///   triangles follow each other around an edge, and across a vertex in one gap between parts that
///   meet there only.
/// Which triangles follow each other where a label meets itself in an edge or a vertex only is
/// decided by positions, with exact signs.
/// REQUIRES and errors: as mesh_betti.  Indicative only when tets overlap.
/// Cost: O(T) plus small sorts a vertex star; 20 bytes a tet, 60 a triangle between labels.
[[nodiscard]] std::vector<RegionBetti> region_betti(const AuditMesh& mesh, std::size_t label_count);

}  // namespace mw::audit
