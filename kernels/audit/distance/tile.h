// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distances of the interfaces in one tile, to all that is near it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/distance/distance.h"
#include "kernels/audit/distance/mesh.h"

namespace mw::audit {

/// Distances of one label in one direction.
struct DistanceTally {
  double largest = 0;
  CompensatedSum sum;
  CompensatedSum weight;
  std::uint64_t far = 0;  ///< samples with nothing of the label in reach

  void add(const DistanceTally& other);
  [[nodiscard]] double mean() const {
    return weight.value() > 0 ? sum.value() / weight.value() : 0;
  }
};

/// Distances of one label in both directions.
struct LabelDistances {
  DistanceTally to_input;
  DistanceTally to_mesh;
  bool in_volume = false;  ///< the label has an interface there
  bool in_mesh = false;

  void add(const LabelDistances& other);
};

/// What is measured.  Everything is in voxels of the lattice that distances count in, from its
/// first corner.
struct DistanceTask {
  VoxelTile voxels;
  /// Pieces of interface triangles; those whose centroid is in the box `samples` are measured.
  std::span<const InterfaceTriangle> pieces;
  std::size_t label_count = 0;
  KeptLabels kept;
  /// The voxels whose lower faces are measured, with the pieces in them.
  Box3 samples;
  /// All faces and pieces that are no farther than this from the samples are here.
  double reach = std::numeric_limits<double>::infinity();
  /// Distances that are no larger than this need not be known any better.
  double limit = kDistanceLimit;
};

/// Measures P4.  A label's boundary consists of the voxel faces, or the triangles, between it and
/// another label of the volume; the sides of the box are no part of it.  Means are by area, over
/// the centres of every fourth voxel face and of pieces of triangles. In a mesh from which labels
/// were left out, triangles of one tet that are not on the box are part of the boundaries of kept
/// labels too.  They are also samples of kLeftOut, whose distances to the faces of labels that were
/// left out are measured.  In the other direction nothing is measured. Returns a row for each
/// label, then one for all labels that the volume does not have, then one for what was left out. It
/// measures the centre of each voxel face and of each piece, then of quarters of the face or halves
/// of the piece, as long as these are larger than kCoveringRadius and may have distances above the
/// limit and above the largest so far.  So the largest distance, if above the limit, is the same
/// however the volume is cut into tiles. Cost: O(log) a sample, mostly one a face and a piece; some
/// 40 bytes a face in the tile, 150 a piece.  Deterministic.
[[nodiscard]] std::vector<LabelDistances> measure_distances(const DistanceTask& task);

/// The report on all tiles.
[[nodiscard]] DistanceReport conclude_distances(std::span<const LabelDistances> rows, double limit,
                                                double reach);

}  // namespace mw::audit
