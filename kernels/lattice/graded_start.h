// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Start mesh on a graded octree: the paper's lattice where labels meet, larger cells inside them.
#pragma once

#include "kernels/core/label_box.h"
#include "kernels/mesh/block_mesh.h"

namespace mw {

/// Weights of the quadrics of Sec 5.2; the paper's by default.
struct QuadricWeights {
  double plane = 1.0;           ///< Eq (1), for each interface voxel face at the vertex
  double boundary_point = 1.0;  ///< Eq (2), vertices on an interface or on the box
  double inner_point = 1.0;     ///< Eq (2), all others
};

struct StartOptions {
  int max_level = 0;          ///< cells of at most 2^max_level voxels; 0: the paper's start mesh
  bool with_samples = false;  ///< samples for the distance bound
  QuadricWeights weights;
};

/// Voxels around a block that its start mesh depends on.
[[nodiscard]] constexpr std::int64_t start_halo(int max_level) {
  return max_level == 0 ? 1 : std::int64_t{2} << max_level;
}

/// Start mesh of a block.
///
/// Each leaf of CellLevels without hanging nodes becomes five tets, in the two mirrored patterns of
/// Sec 5.1 at its own scale: diagonals join corners of even coordinate sum, counted in cells.  Any
/// other leaf gets a centre vertex joined to the triangles of its faces; a face beside smaller
/// cells takes their triangles, a face with hanging nodes on its edges only is a fan from the one
/// of smallest id.  Both sides of a face find the same triangles, so cells and blocks conform.
/// Eq (1) sums over interface triangles; here over interface voxel faces at the vertex, which is
/// the same sum freed from the accident of the pattern.
///
/// REQUIRES: labels cover `block` and start_halo(max_level) around it; the block is inside the
///           volume and starts at a multiple of 2^max_level.
/// ENSURES: canonical; a local function of the labels: all blocks give a shared vertex the same id,
///          position and quadric.  Each voxel face between two labels whose smaller label is in the
///          block has its samples on the start triangle that they lie on.
[[nodiscard]] BlockMesh graded_start(const LabelBox& labels, const Box3& block, Index3 volume,
                                     const StartOptions& options);

}  // namespace mw
