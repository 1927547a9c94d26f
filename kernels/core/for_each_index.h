// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Walks over boxes of indices.
#pragma once

#include "kernels/core/index.h"

namespace mw {

/// Calls visit for every index of the box, x fastest.
template <typename Visit>
void for_each_index(const Box3& box, Visit visit) {
  for (Index3 i = box.lo; i.z < box.hi.z; ++i.z) {
    for (i.y = box.lo.y; i.y < box.hi.y; ++i.y) {
      for (i.x = box.lo.x; i.x < box.hi.x; ++i.x) visit(i);
    }
  }
}

/// The same for an array of the given shape.
template <typename Visit>
void for_each_index(Index3 shape, Visit visit) {
  for_each_index(Box3{{0, 0, 0}, shape}, visit);
}

}  // namespace mw
