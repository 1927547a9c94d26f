// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The quadric of a voxel corner, from the eight voxels around it (Sec 5.2).
#pragma once

#include "kernels/core/label_box.h"
#include "kernels/lattice/graded_start.h"
#include "kernels/quadric/quadric.h"

namespace mw {

/// REQUIRES: labels cover the eight voxels around the corner.
[[nodiscard]] Quadric corner_quadric(const LabelBox& labels, Index3 corner,
                                     const QuadricWeights& weights);

}  // namespace mw
