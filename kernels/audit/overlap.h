// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Do the tets of a mesh with gaps overlap (promise P2)?
#pragma once

#include "kernels/audit/check.h"
#include "kernels/audit/mesh_stars.h"

namespace mw::audit {

/// "P2 overlap": along a line through every column of voxels along z, space is in no tet or in one.
/// Where all other triangles have tets on both sides, only those of one tet tell how many there are
/// on the way; what is between two of them that are less than 1e-6 voxel apart is not looked at.
/// So tets that overlap in less than a voxel's width may go unseen: a sample, no proof.
/// REQUIRES: finite vertices, positive spacing.  Cost: some 24 bytes a line and triangle that meet.
[[nodiscard]] Check check_overlap(const MeshStars& stars, const Frame& frame, Index3 shape);

}  // namespace mw::audit
