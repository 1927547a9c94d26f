// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts the faces between voxels of different labels by brick, which shows where the work is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/label.h"

namespace mw::engine {

/// Faces between two voxels of one brick with different labels.  Those between bricks are left out,
/// so that the counts are a function of the labels alone: what is read at once, and so how much is
/// seen around a brick, depends on how the volume is stored.  Memory: 2 bytes for 16^3 voxels.
class BoundaryFaces {
 public:
  BoundaryFaces() = default;
  /// Begins with no faces.
  explicit BoundaryFaces(Index3 volume);

  /// Counts the faces of a brick, whose voxels are given, x fastest.
  /// REQUIRES: they are all its voxels in the volume.  Thread safety: different bricks may be
  /// counted at once.
  void count(Index3 brick, std::span<const Label> voxels);

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
