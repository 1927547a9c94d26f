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
  /// REQUIRES: not empty, kLanes entries at most.
  explicit FaceGroup(std::span<const FaceSamples> faces) : size(faces.size()) {
    for (std::size_t k = 0; k < kLanes; ++k) samples[k] = faces[std::min(k, size - 1)];
  }

  std::array<FaceSamples, kLanes> samples;  ///< what is beyond the last one repeats it
  std::size_t size;
};

/// The quarters that a triangle carries of up to four voxel faces; what is beyond the last one
/// repeats it.
struct PieceGroup {
  PointLanes middles;    ///< means of the quarters' samples, in voxels
  StoredLanes quarters;  ///< how many
  StoredLanes signs;     ///< of the way along the axis from the smaller label to the larger
  StoredInts axes;       ///< of the faces
  std::size_t size;
};

/// low: the smaller label at the faces, which are in the box.
[[nodiscard]] PieceGroup pieces_of(const FaceGroup& faces, const LabelBox& labels, Label low);

/// The centres of faces, and which of them look a triangle's way.
struct FaceCentres {
  PointLanes points;     ///< in voxels
  unsigned looking = 0;  ///< one bit for each that does
};

/// A face looks the way of a triangle when the cosine between its normal, from `low` to the larger
/// label, and `unit_normal` is not below `min_cosine`.
[[nodiscard]] FaceCentres centres_of(const FaceGroup& faces, const LabelBox& labels, Label low,
                                     const Vec3& unit_normal, double min_cosine);

}  // namespace mw
