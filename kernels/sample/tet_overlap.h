// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much of each voxel of an image a tet covers.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "kernels/core/index.h"

namespace mw {

/// Coordinates in voxels of the image: voxel v is the unit cube from corner v to corner v + 1.
using ImagePoint = std::array<double, 3>;

/// Voxels of a row along x from `first` on, and how much of each a tet covers: up to 1, and 0 or a
/// rounding error of some 1e-16 of either sign where it covers nothing.
struct CoveredRow {
  Index3 first;
  std::span<const double> volumes;
};

/// A tet over the grid of an image.  The volume of tet and voxel together is an integral over the
/// tet's faces (the divergence theorem along x), which are clipped to columns of voxels: exact up
/// to rounding, some 1e-14 of a voxel.
class TetOverlap {
 public:
  /// Corners may be in either orientation.  REQUIRES: finite coordinates.
  explicit TetOverlap(const std::array<ImagePoint, 4>& corners);

  /// The volume of the tet, in voxels.
  [[nodiscard]] double volume() const { return volume_; }
  /// The voxels of an image of this shape that the tet may cover; may be empty.
  [[nodiscard]] Box3 box(Index3 shape) const;
  /// Calls visit for each row of the box that the tet meets, y within z ascending.
  /// ENSURES: up to rounding, the volume that is told of a voxel does not depend on the box.
  /// Cost: a clipped polygon for each column, and for each voxel that a face passes through.
  void cut(const Box3& box, const std::function<void(const CoveredRow& row)>& visit) const;

 private:
  ImagePoint base_{};                    ///< whole numbers, near the corner of the tet's box
  std::array<ImagePoint, 4> corners_{};  ///< from base_, in positive orientation
  double volume_ = 0;
};

}  // namespace mw
