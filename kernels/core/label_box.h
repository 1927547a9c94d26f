// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A box of dense labels, part of a volume; what lies outside the volume is exterior.
#pragma once

#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw {

/// Labels of the voxels of `box`, x fastest.  The box may reach outside the volume; voxels there
/// are kExterior.
struct LabelBox {
  Box3 box;
  std::vector<Label> labels;

  /// REQUIRES: box.contains(voxel).
  [[nodiscard]] Label at(Index3 voxel) const {
    MW_ASSERT(box.contains(voxel));
    return labels[static_cast<std::size_t>(box.offset(voxel))];
  }
};

}  // namespace mw
