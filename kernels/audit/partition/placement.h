// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where labels lie as a whole: whether a mesh is that of the volume, or of its mirror image.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernels/audit/check.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// Sums over labels of volume, and of volume times place, in voxels from the middle of the box.
struct PlaceTally {
  PlaceTally() = default;
  explicit PlaceTally(std::size_t labels) : volumes(labels), moments(labels) {}

  /// labels: of the other's labels, here.
  void add(const PlaceTally& other, std::span<const Label> labels);

  std::vector<double> volumes;
  std::vector<std::array<double, 3>> moments;
};

/// Measures the tets that a tile owns.  frame, shape: of the volume.
/// REQUIRES: labels of the volume < label_count; finite vertices.
[[nodiscard]] PlaceTally places_of_mesh(const MeshTile& tile, std::size_t label_count,
                                        const Frame& frame, Index3 shape);
/// Measures the voxels of a box; exact.  shape: of the whole volume.  REQUIRES: labels <
/// label_count.
[[nodiscard]] PlaceTally places_of_voxels(const Box3& box, std::span<const Label> labels,
                                          std::size_t label_count, Index3 shape);

/// "P4 place": whatever bound there is on distances, or none, the centres of labels are not in a
/// mirror, nor turned.  They are held against those of the voxels as they are, and as each symmetry
/// of the box would place them: fails when one of these fits more than three times as well, and the
/// mesh as it is not within a voxel.  Labels that one side does not have do not count.
[[nodiscard]] Check judge_places(const PlaceTally& volume, const PlaceTally& mesh, Index3 shape);

}  // namespace mw::audit
