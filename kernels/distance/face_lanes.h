// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxel faces that carry samples, unpacked four at a time.
#pragma once

#include <algorithm>
#include <span>

#include "kernels/core/face_sample.h"
#include "kernels/core/label.h"
#include "kernels/core/lanes.h"
#include "kernels/distance/point_triangle.h"

namespace mw {

/// The samples of up to four faces.
struct FaceGroup {
  /// REQUIRES: 1 to kLanes faces.
  explicit FaceGroup(std::span<const FaceSamples> faces) : size(faces.size()) {
    for (std::size_t k = 0; k < kLanes; ++k) samples[k] = faces[std::min(k, size - 1)];
  }

  std::array<FaceSamples, kLanes> samples;  ///< entries beyond the last face repeat it
  std::size_t size;
};

/// The quarters that a triangle carries of up to four voxel faces; entries beyond the last face
/// repeat it.
struct PieceGroup {
  PointLanes middles;    ///< means of the quarters' samples, in voxels
  StoredLanes quarters;  ///< numbers of quarters
  StoredLanes signs;     ///< as in DistanceGuard::Piece
  StoredInts axes;       ///< axes of the faces
  std::size_t size;
};

/// Unpacks faces whose smaller label is `low`.  REQUIRES: their voxels are in the box of `labels`.
[[nodiscard]] PieceGroup pieces_of(const FaceGroup& faces, const LabelBox& labels, Label low);

/// The centres of faces, and which of them look a triangle's way.
struct FaceCentres {
  PointLanes points;     ///< in voxels
  unsigned looking = 0;  ///< one bit for each face that does
};

/// A face looks the way of a triangle when the cosine between its normal, from `low` to the larger
/// label, and `unit_normal` is not below `min_cosine`.
[[nodiscard]] FaceCentres centres_of(const FaceGroup& faces, const LabelBox& labels, Label low,
                                     const Vec3& unit_normal, double min_cosine);

}  // namespace mw
