// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The smooth surface that voxels were sampled from, face by face.
#pragma once

#include <vector>

#include "kernels/core/label.h"
#include "kernels/source/source_plane.h"

namespace mw {

/// How far around a voxel labels have a say in the planes of its faces, in voxels.
inline constexpr std::int64_t kSourceHalo = 17;

/// For each voxel of a box the planes of the faces on its upper sides.
class SourceSurface {
 public:
  SourceSurface() = default;

  /// Finds the planes of all faces between two labels whose lower voxel is in `box`.
  /// labels: of the box and kSourceHalo around it; voxels outside the volume are kExterior, where
  /// the surface ends.
  SourceSurface(const LabelBox& labels, const Box3& box);

  [[nodiscard]] const Box3& box() const { return box_; }
  /// REQUIRES: a face between two labels, whose lower voxel is in box().
  [[nodiscard]] PackedPlane at(Index3 lower, unsigned axis) const {
    MW_ASSERT(box_.contains(lower));
    return planes_[3 * static_cast<std::size_t>(box_.offset(lower)) + axis];
  }

 private:
  Box3 box_;
  std::vector<PackedPlane> planes_;
};

}  // namespace mw
