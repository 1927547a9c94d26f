// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The quadric of a voxel corner, from the eight voxels around it (Sec 5.2).
#pragma once

#include "kernels/core/label.h"
#include "kernels/quadric/quadric.h"
#include "kernels/start/graded_start.h"

namespace mw {

/// REQUIRES: labels cover the eight voxels around the corner.
[[nodiscard]] Quadric corner_quadric(const LabelBox& labels, Index3 corner,
                                     const QuadricWeights& weights);

/// Quadric of a corner of coarsened labels: the planes come from the input's interface faces
/// between labels that meet at the corner, as far as two voxels away.  For each pair of labels they
/// make one plane, through the faces' mean centre and across their mean normal, so that the
/// vertices are drawn to a smooth surface through the input's steps.
/// REQUIRES: shape covers the eight voxels around the corner, original the 64.
[[nodiscard]] Quadric wide_quadric(const StartLabels& labels, Index3 corner,
                                   const StartOptions& options);

}  // namespace mw
