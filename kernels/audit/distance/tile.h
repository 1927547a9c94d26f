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

/// Both directions.
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
  /// Those whose centroid is in the box of `samples` are measured.
  std::span<const InterfaceTriangle> pieces;
  std::size_t label_count = 0;
  KeptLabels kept;
  /// Voxels whose lower faces, and the pieces in which, are measured.
  Box3 samples;
  /// All faces and pieces that are no farther than this from the samples are here.
  double reach = std::numeric_limits<double>::infinity();
  /// Where distances are no larger than this, nobody asks how large they are.
  double limit = kDistanceLimit;
};

/// Rows are labels, then all that the volume does not have, then what was left out.
/// First the centre of each voxel face and of each piece; then halves of it, as long as there may
/// be distances on it that are larger than the limit and than any before, and it is larger than
/// kCoveringRadius.  So the largest distance, if above the limit, is the same however the volume is
/// cut into tiles.
/// Cost: O(log) a sample, mostly one a face and a piece; some 40 bytes a face in the tile, 150 a
/// piece.  Deterministic.
[[nodiscard]] std::vector<LabelDistances> measure_distances(const DistanceTask& task);

/// The report on all tiles.
[[nodiscard]] DistanceReport conclude_distances(std::span<const LabelDistances> rows, double limit,
                                                double reach);

}  // namespace mw::audit
