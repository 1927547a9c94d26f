// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the scores of two labels are equal: between two voxels, and near a point where a function
// that is known at the centres of voxels is zero.
#pragma once

#include <array>
#include <optional>

#include "kernels/core/index.h"
#include "kernels/core/metric.h"
#include "kernels/source/source_plane.h"

namespace mw {

/// The score of the label below a face less that of the label above it, at the centres of the
/// voxels below and above; arrays have the lower one first.
struct ScoreDifference {
  std::array<double, 2> values{};
  std::array<Vec3, 2> slopes{Vec3::Zero(), Vec3::Zero()};  ///< by central differences, per voxel
};

/// Finds the zero of the difference on the way from centre to centre, and the direction there in
/// which it falls most.  Between the centres the difference is taken for the cubic with the values
/// and slopes at both ends, slopes limited so that it falls all the way (Fritsch and Carlson,
/// 1980).  A straight line would be off by 1 / 12 of the second derivative, 0.35 % of the volume of
/// a ball of radius 6.  The height of the result is that of the crossing over the face, along the
/// axis, in voxels.  Scores that do not cross there (the label was changed since, or they are equal
/// or infinite at both ends) give the face itself.
[[nodiscard]] SourcePlane find_crossing(const ScoreDifference& difference, unsigned axis);

/// Returns the form of crossings, whose heights are along the axes of their faces, where a voxel of
/// scores has `layers` voxels of the lattice: a crossing is up to half a voxel of scores from its
/// face.  Heights are good to half a unit of the lattice for one layer, and to that times the
/// largest number of layers.
[[nodiscard]] PlaneForm crossing_form(Index3 layers);

/// A face of the lattice, where scores belong to voxels of several layers.
struct LayeredFace {
  unsigned axis = 0;
  Index3 layers{1, 1, 1};  ///< how many voxels of the lattice a voxel of scores has
  /// The face's centre, relative to the middle between the centres of the two voxels of scores; in
  /// voxels of the lattice.
  Vec3 centre = Vec3::Zero();
};

/// Returns the crossing's plane with its height over the centre of a face of the lattice, along the
/// axis.  ENSURES: a height within the reach of crossing_form(face.layers).
[[nodiscard]] SourcePlane on_lattice(const SourcePlane& crossing, const LayeredFace& face);

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
