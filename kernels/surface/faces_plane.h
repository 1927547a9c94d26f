// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The plane of the voxel faces between two labels near a place.
#pragma once

#include <optional>

#include "kernels/core/label.h"
#include "kernels/core/metric.h"

namespace mw {

/// A plane beside a place.
struct FacesPlane {
  Vec3 normal;          ///< unit vector
  double height = 0.0;  ///< from the place to the plane, along the normal, metric units
};

/// Returns the plane that is nearest to the faces between two labels around a place, by least
/// squares.  A face at distance d counts nearly exp(-d^2 / 18) times its area along `towards_high`,
/// d in smallest edges of a voxel and 6 at most.  Faces of which this area is less than a tenth do
/// not count: so the other side of a thin sheet does not.
///
/// Beside a line of three labels all faces of a pair lie on one side, and the plane goes on beyond
/// them, while a mean of their places would be drawn away from the line.
///
/// Returns nothing where faces are more than half a voxel from the plane in the mean, where they
/// are less than 0.8 voxel wide (both rms), and where the plane is tilted by more than 37 degrees
/// against towards_high, a unit vector from pair.low to pair.high.
/// Cost: 2,197 voxels, where these are cubes.
[[nodiscard]] std::optional<FacesPlane> plane_of_faces(const LabelBox& labels, const Metric& metric,
                                                       Point place, LabelPair pair,
                                                       const Vec3& towards_high);

}  // namespace mw
