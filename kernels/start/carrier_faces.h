// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxel faces near a voxel face: which of them can carry its samples.
#pragma once

#include <array>
#include <vector>

#include "kernels/core/face_sample.h"
#include "kernels/core/label.h"

namespace mw {

/// The face between `lower` and the next voxel along the axis.
struct VoxelFace {
  Index3 lower;
  unsigned axis = 0;

  friend bool operator==(const VoxelFace&, const VoxelFace&) = default;
  [[nodiscard]] Index3 upper() const { return lower + axis_vector(axis); }
};

/// The labels on its two sides.
[[nodiscard]] inline LabelPair labels_beside(const LabelBox& labels, const VoxelFace& face) {
  return label_pair(labels.at(face.lower), labels.at(face.upper()));
}

/// True when `carrier`, a face of the coarsened labels, may carry the samples of `face`, one of the
/// input's: the same labels are on its sides, and in the same order where both have one axis
/// (samples of one side of a thin sheet that hang on the other would pin both).
[[nodiscard]] inline bool may_carry(const LabelBox& coarsened, const VoxelFace& carrier,
                                    const LabelBox& original, const VoxelFace& face) {
  const LabelPair pair = labels_beside(original, face);
  if (labels_beside(coarsened, carrier) != pair) return false;
  return carrier.axis != face.axis || coarsened.at(carrier.lower) == original.at(face.lower);
}

/// The largest bound that coarsening makes use of, in voxels.
inline constexpr double kMaxCoarseDistance = 1.5;

/// Lists for a face f the faces g that have, for each of the four samples of f
/// (kernels/core/face_sample.h), a point within D less the covering radius.  If one of them lies
/// between the same labels as f does in the input, it can carry the samples of f, and the distance
/// bound holds there.  (A carrier for each sample by itself lets no more cubes become uniform.)
class CarrierFaces {
 public:
  /// REQUIRES: max_distance > 0; larger values count as kMaxCoarseDistance.
  /// ENSURES: no face listed for f is more than one voxel away from it along any axis.
  explicit CarrierFaces(double max_distance);

  /// The faces g relative to f = ({0, 0, 0}, axis): f itself first, then by distance, with ties in
  /// a fixed order.
  [[nodiscard]] const std::vector<VoxelFace>& of(unsigned axis) const { return carriers_[axis]; }
  /// The faces f, relative to g, that g = ({0, 0, 0}, axis) can carry.
  [[nodiscard]] const std::vector<VoxelFace>& carried_by(unsigned axis) const {
    return carried_[axis];
  }

 private:
  void find_carriers(unsigned axis, double reach);

  std::array<std::vector<VoxelFace>, 3> carriers_;
  std::array<std::vector<VoxelFace>, 3> carried_;
};

}  // namespace mw
