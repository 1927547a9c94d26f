// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cuts a box into slabs of bounded size.
#pragma once

#include <algorithm>

#include "kernels/core/index.h"

namespace mw::io {

/// Calls visit(Box3) on boxes that cover box in file order (x fastest), each of at most max_voxels
/// voxels or one row: whole planes, or rows of one plane.  Each is contiguous in an array over box.
template <class Visit>
void for_each_z_slab(const Box3& box, std::int64_t max_voxels, Visit visit) {
  const Index3 shape = box.shape();
  const std::int64_t rows = std::clamp<std::int64_t>(max_voxels / shape.x, 1, shape.y);
  const std::int64_t planes =
      rows == shape.y ? std::clamp<std::int64_t>(max_voxels / (shape.x * shape.y), 1, shape.z) : 1;
  for (std::int64_t z = box.lo.z; z < box.hi.z; z += planes) {
    for (std::int64_t y = box.lo.y; y < box.hi.y; y += rows) {
      visit(Box3{{box.lo.x, y, z},
                 {box.hi.x, std::min(y + rows, box.hi.y), std::min(z + planes, box.hi.z)}});
    }
  }
}

/// The same along x, for volumes whose fastest axis is z.
template <class Visit>
void for_each_x_slab(const Box3& box, std::int64_t max_voxels, Visit visit) {
  const auto turned = [](const Index3& v) { return Index3{v.z, v.y, v.x}; };
  for_each_z_slab(Box3{turned(box.lo), turned(box.hi)}, max_voxels, [&](const Box3& slab) {
    visit(Box3{turned(slab.lo), turned(slab.hi)});
  });
}

}  // namespace mw::io
