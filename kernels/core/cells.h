// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells of equal size that a volume is cut into.
#pragma once

#include "kernels/core/index.h"

namespace mw {

/// The cells that a box meets, cell c being the voxels from c * cell on.
/// REQUIRES: box.lo not negative, cell positive on every axis.
[[nodiscard]] inline Box3 cells_of(const Box3& box, Index3 cell) {
  const auto rounded_up = [](std::int64_t a, std::int64_t b) { return (a + b - 1) / b; };
  return {
      {box.lo.x / cell.x, box.lo.y / cell.y, box.lo.z / cell.z},
      {rounded_up(box.hi.x, cell.x), rounded_up(box.hi.y, cell.y), rounded_up(box.hi.z, cell.z)}};
}

}  // namespace mw
