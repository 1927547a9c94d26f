// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How thick the parts of labels are that have two opposite sides near each other.
#pragma once

#include <functional>

#include "kernels/core/label.h"
#include "kernels/core/metric.h"

namespace mw {

/// Parts that are thicker than twice this, in voxels, are not looked at.
inline constexpr std::int64_t kThinReach = 16;
/// Labels are needed this far around the voxels that are asked about, in voxels.
inline constexpr std::int64_t kThinHalo = kThinReach + 7;

/// Calls found for each voxel of `asked` in the middle of a thin part, x fastest, with the
/// thickness of its label there.
///
/// The thickness is measured along 13 directions: the axes, and the diagonals of faces and of
/// cubes.  A voxel is in the middle along one of them when
/// - both sides of its label are equally far, to within a step;
/// - no side is much nearer along another direction: 0.85 of that is allowed, so that plates in any
///   direction count (22 degrees are between a direction and the next), while the corners and edges
///   of a thick part do not;
/// - the part does not get thicker beside it: four steps away, sides are at most 0.75 of a voxel
///   farther away, so that neither the tip of a wedge counts nor the steps of voxels on a face.
/// Thicknesses are lengths of the metric.  The end of the volume (kExterior) is a side, too,
/// because what is computed on the mesh ends there.  REQUIRES: labels has kThinHalo around `asked`.
/// Cost: some 150 steps a voxel of labels; 6 bytes a voxel.
void for_each_thin_voxel(const LabelBox& labels, const Box3& asked, const Metric& metric,
                         const std::function<void(Index3 voxel, double thickness)>& found);

}  // namespace mw
