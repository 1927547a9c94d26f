// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts the faces between voxels of different labels by brick, which shows where the work is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/label.h"

namespace mw::engine {

/// Faces between two voxels of the volume with different labels; each counts for the voxel below
/// it.  Memory: 2 bytes for 16^3 voxels.
class BoundaryFaces {
 public:
  BoundaryFaces() = default;
  /// Begins with no faces.
  explicit BoundaryFaces(Index3 volume);

  /// Counts the faces of a brick, except those that it shares with voxels outside `labels`.
  /// uniform says that the brick has one label, hence no faces inside.
  /// REQUIRES: labels cover the brick.  Thread safety: different bricks may be counted at once.
  void count(const LabelBox& labels, Index3 brick, bool uniform);

  /// Returns the number of faces of each brick, x fastest.
  [[nodiscard]] std::span<const std::uint16_t> counts() const { return faces_; }
  /// Adds the counts of the bricks from number `first` on, which another process has counted.
  void add(std::size_t first, std::span<const std::uint16_t> counts);

  /// Returns the number of faces in a box, as if those of each brick were spread evenly over it.
  [[nodiscard]] double in(const Box3& box) const;

 private:
  [[nodiscard]] Box3 box_of(Index3 brick) const;
  [[nodiscard]] std::size_t row(Index3 brick) const {
    return static_cast<std::size_t>((brick.z * bricks_.y + brick.y) * bricks_.x + brick.x);
  }

  Index3 volume_;
  Index3 bricks_;
  std::vector<std::uint16_t> faces_;
};

}  // namespace mw::engine
