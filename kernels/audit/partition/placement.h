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

/// Sums for each label: volume, and volume times position, in voxels from the middle of the box.
struct PlaceTally {
  PlaceTally() = default;
  explicit PlaceTally(std::size_t labels) : volumes(labels), moments(labels) {}

  /// Adds another tally, whose label l is labels[l] here.
  void add(const PlaceTally& other, std::span<const Label> labels);

  std::vector<double> volumes;
  std::vector<std::array<double, 3>> moments;
};

/// Measures the tets that a tile owns.  frame and shape are those of the volume.
/// REQUIRES: labels of the volume < label_count; finite vertices.
[[nodiscard]] PlaceTally places_of_mesh(const MeshTile& tile, std::size_t label_count,
                                        const Frame& frame, Index3 shape);
/// Measures the voxels of a box exactly.  shape is that of the whole volume.
/// REQUIRES: labels < label_count.
[[nodiscard]] PlaceTally places_of_voxels(const Box3& box, std::span<const Label> labels,
                                          std::size_t label_count, Index3 shape);

/// Returns the check "P4 place": the centres of labels are neither mirrored nor turned, whether or
/// not distances have a bound.  They are compared with those of the voxels as they are, and as each
/// symmetry of the box would place them.  The check fails when a symmetry fits more than three
/// times as well and the mesh is off by more than a voxel.  Labels of one side only do not count.
[[nodiscard]] Check judge_places(const PlaceTally& volume, const PlaceTally& mesh, Index3 shape);

}  // namespace mw::audit
