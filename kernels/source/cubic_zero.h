// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The place near a point where a function that is known at the centres of voxels is zero.
#pragma once

#include <array>
#include <optional>

#include "kernels/core/index.h"
#include "kernels/core/metric.h"

namespace mw {

/// Values at the centres of 4 x 4 x 4 voxels, x fastest.
using CubicValues = std::array<double, 64>;

/// A value, and by how much it rises in a voxel along each axis.
struct ValueAndSlope {
  double value = 0.0;
  Vec3 slope = Vec3::Zero();
};

/// Interpolates between the middle eight of the centres, by cubics with central differences for
/// slopes (Catmull and Rom, 1974), along each axis.  `at` has coordinates from 0 to 1.
[[nodiscard]] ValueAndSlope interpolate(const CubicValues& values, const Vec3& at);

/// The values that are interpolated in a volume.
class CubicField {
 public:
  virtual ~CubicField() = default;
  /// Returns the values at the voxels from `first` on; those outside of the volume are those of
  /// the nearest voxel inside.
  [[nodiscard]] virtual CubicValues values_from(Index3 first) const = 0;
};

/// Returns the place where the field is zero that is reached from `near` by steps across the field
/// (Newton's method); nothing when there is none within `reach` voxels.  Coordinates are in voxels
/// from the first corner of the volume; steps are shortest in units of `voxel`.
[[nodiscard]] std::optional<Vec3> find_zero(const CubicField& field, const Vec3& near,
                                            const Vec3& voxel, double reach);

}  // namespace mw
