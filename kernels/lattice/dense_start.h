// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The paper's start mesh: five tetrahedra a voxel, in two mirrored patterns (Sec 5.1, Fig 5).
#pragma once

#include "kernels/core/label_box.h"
#include "kernels/lattice/graded_start.h"
#include "kernels/mesh/block_mesh.h"

namespace mw {

/// Start mesh of a block: the tets of its voxels and their vertices with quadrics.
///
/// Diagonals join voxel corners of even coordinate sum, so neighbouring voxels agree on every face
/// and so do neighbouring blocks.  Eq (1) sums over interface triangles; here over interface voxel
/// faces, which is the same sum freed from the accident of the pattern.
/// REQUIRES: labels cover `block` and one voxel around it; block is inside the volume of shape
///           `volume`.
/// ENSURES: canonical; a local function of the labels: all blocks give a shared vertex the same id,
///          position and quadric.  No samples; see interface_samples().
[[nodiscard]] BlockMesh dense_start(const LabelBox& labels, const Box3& block, Index3 volume,
                                    const QuadricWeights& weights);

/// The samples of the voxel faces between two labels of the volume whose smaller label is in
/// `block`, each on the start triangle that it lies on.  Same preconditions; canonical.
[[nodiscard]] std::vector<BlockSample> interface_samples(const LabelBox& labels, const Box3& block,
                                                         Index3 volume);

}  // namespace mw
