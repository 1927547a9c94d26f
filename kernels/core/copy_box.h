// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels from one array to another.
#pragma once

#include <algorithm>
#include <span>

#include "kernels/core/index.h"

namespace mw {

/// Copies the voxels of `part` from the array of one box to that of another, both x fastest.
/// REQUIRES: both boxes contain part, and the arrays have all voxels of their boxes.
template <typename Voxel>
void copy_box(const Box3& part, const Box3& from_box, std::span<const Voxel> from,
              const Box3& to_box, std::span<Voxel> to) {
  for (Index3 v = part.lo; v.z < part.hi.z; ++v.z) {
    for (v.y = part.lo.y; v.y < part.hi.y; ++v.y) {
      std::copy_n(from.data() + from_box.offset(v), part.shape().x, to.data() + to_box.offset(v));
    }
  }
}

}  // namespace mw
