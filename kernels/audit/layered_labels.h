// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The input with its voxels cut into layers: the lattice that distances are measured in.
#pragma once

#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// The same solid as a volume, on a finer lattice.
struct LayeredLabels {
  Index3 shape;
  std::vector<Label> labels;

  [[nodiscard]] VoxelLabels view() const { return {.shape = shape, .labels = labels}; }
};

/// Repeats each voxel `layers` times along each axis.
/// REQUIRES: layers from 1 to kMaxLayers.  Errors: kResource above 2^20 voxels along an axis.
/// Cost: 4 bytes a layered voxel.
[[nodiscard]] LayeredLabels layered_labels(const VoxelLabels& volume, Index3 layers);

/// The frame of layered_labels().
[[nodiscard]] Frame layered_frame(const Frame& frame, Index3 layers);

}  // namespace mw::audit
