// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Start mesh on a graded octree: cells of one or two voxels where labels meet, larger ones inside.
#pragma once

#include <cstdint>

#include "kernels/core/label.h"
#include "kernels/mesh/block_mesh.h"
#include "kernels/start/cells/cell_levels.h"

namespace mw {

class CellTemplates;

/// Weights of the quadrics of Sec 5.2; the paper's by default.
struct QuadricWeights {
  double plane = 1.0;           ///< Eq (1), for each interface voxel face at the vertex
  double boundary_point = 1.0;  ///< Eq (2), vertices on an interface or on the box
  double inner_point = 1.0;     ///< Eq (2), all others
};

struct StartOptions {
  int max_level = 0;          ///< cells have at most 2^max_level voxels an axis; 0 is the paper's
  bool coarse = false;        ///< shape labels may differ from the input's
  bool with_samples = false;  ///< samples for the distance bound
  double max_distance = 1.5;  ///< the distance bound of samples, in voxels
  QuadricWeights weights;
  Metric metric;                       ///< for quadrics, and for shapes of cells
  double quality_floor = 0.0;          ///< no tet below it, if the metric allows (min_start_ratio)
  const SizeField* sizes = nullptr;    ///< edges keep to these limits, if they are at least the
                                       ///< diagonal of a voxel; null for none
  CellTemplates* templates = nullptr;  ///< lent for one block at a time, to spare work; may be
                                       ///< null.  REQUIRES: of this metric and quality floor.
};

/// Voxels around a block whose labels its start mesh depends on.
inline constexpr std::int64_t kStartHalo = LevelMap::kHalo;

/// What a start mesh is made from.  Both cover the same box.
struct StartLabels {
  const LabelBox& shape;     ///< labels of the cells: the input's, or coarsened ones (coarsen.h)
  const LabelBox& original;  ///< the input's labels, for quadrics and samples
};

/// Start mesh of a block.
///
/// Leaves of CellLevels larger than a voxel are cut by cut_cell(): without hanging nodes, into the
/// five tets of Sec 5.1 at their own scale.  With max_level 0 voxels are cut in the same way, which
/// is the paper's start mesh; else eight voxels that are partners become a mixed cell: the cone
/// from its centre over its surface, whose tets take the labels of the voxels that they are in.
/// SurfaceNodes says which middles of edges and faces are vertices, face_triangles() how a face is
/// cut; both sides find the same, so cells and blocks conform.
/// Eq (1) sums over interface triangles.  Here the sum is over the interface voxel faces at the
/// vertex, so that it does not depend on the pattern of the tets.
///
/// Samples of an input face go to the triangles on the nearest face between the same two labels
/// (CarrierFaces); without coarsening that is the face itself.
///
/// REQUIRES: labels cover `block` and kStartHalo around it; the block is inside the volume and
///           starts at a multiple of 2^max_level; levels were found for the shape labels and the
///           sizes (they are not used for max_level <= 2).
/// ENSURES: canonical; a local function of the labels: all blocks give a shared vertex the same id,
///          position and quadric.  Each sample of each voxel face between two labels is with the
///          one block that holds the tet on the smaller label's side of its triangle.
[[nodiscard]] BlockMesh graded_start(const StartLabels& labels, const LevelMap& levels,
                                     const Box3& block, Index3 volume, const StartOptions& options);

/// How much a start mesh holds.
struct StartSize {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t samples = 0;
};

/// Returns how much graded_start() of the same arguments holds; samples are an upper bound.
/// Cost: a third of graded_start(), without its quadrics, sorting and samples.
[[nodiscard]] StartSize graded_start_size(const StartLabels& labels, const LevelMap& levels,
                                          const Box3& block, Index3 volume,
                                          const StartOptions& options);

}  // namespace mw
