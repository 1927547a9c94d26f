// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The input's interface: its voxel faces between labels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "kernels/audit/distance/trees.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// The face between voxel `upper` and the one below it along `axis`.
struct VoxelFace {
  std::array<std::uint32_t, 3> upper{};
  std::uint32_t axis = 0;
};

[[nodiscard]] Extent extent_of(const VoxelFace& face);
/// The labels below and above the face.
[[nodiscard]] LabelPair labels_of(const VoxelFace& face, const VoxelLabels& volume);

/// Every face between two labels, in the order of a space-filling curve.
/// Errors: kResource for more than 2^20 voxels along an axis, or from 2^32 - 1 faces on.
[[nodiscard]] std::vector<VoxelFace> interface_faces(const VoxelLabels& volume);

/// A corner of voxels where labels meet, with the labels of the eight voxels around it: bit k of an
/// index stands for the upper side of axis k.  Voxels outside the box are kExterior.
struct MixedCorner {
  std::array<std::uint32_t, 3> at{};
  std::array<Label, 8> around{};
};

/// Visits the corners around which there are two labels or more, x fastest.
class MixedCorners {
 public:
  /// REQUIRES: at least one voxel; corners from 0 to the shape; `volume` outlives this.
  MixedCorners(const VoxelLabels& volume, const Box3& corners)
      : volume_(volume), corners_(corners) {}

  template <class Visit>
  void visit(Visit&& visit) const {
    for (std::int64_t z = corners_.lo.z; z < corners_.hi.z; ++z) {
      for (std::int64_t y = corners_.lo.y; y < corners_.hi.y; ++y) visit_row(y, z, visit);
    }
  }

 private:
  /// The four rows of voxels around a row of corners.  Outside the box they are the nearest rows
  /// inside, which adds no label.
  [[nodiscard]] std::array<const Label*, 4> rows(std::int64_t y, std::int64_t z) const;
  [[nodiscard]] MixedCorner corner(Index3 at, const std::array<const Label*, 4>& rows) const;

  template <class Visit>
  void visit_row(std::int64_t y, std::int64_t z, Visit& visit) const {
    const std::array<const Label*, 4> row = rows(y, z);
    const std::int64_t last = volume_.shape.x - 1;
    // Beyond its ends a row repeats its first and last voxel, which adds no label.
    const auto column = [&](std::int64_t x) {
      const std::int64_t i = std::clamp<std::int64_t>(x, 0, last);
      const Label label = row[0][i];
      return std::pair(label, label == row[1][i] && label == row[2][i] && label == row[3][i]);
    };
    std::pair<Label, bool> before = column(corners_.lo.x - 1);
    for (std::int64_t x = corners_.lo.x; x < corners_.hi.x; ++x) {
      const std::pair<Label, bool> here = column(x);
      const bool is_mixed = !here.second || here != before;
      if (is_mixed) visit(corner({x, y, z}, row));
      before = here;
    }
  }

  const VoxelLabels& volume_;
  Box3 corners_;
};

/// The nearest voxel faces of two labels, when they are close.
class CloseFaces {
 public:
  static constexpr double kReach = 1;  ///< voxels

  struct Near {
    double squared = std::numeric_limits<double>::infinity();
    Extent face{};  ///< what is that far away; valid if squared is finite
  };

  /// REQUIRES: at least one voxel; `volume` outlives this.
  explicit CloseFaces(const VoxelLabels& volume) : volume_(volume) {}

  /// Finds for each label the squared distance from p to its nearest face, and that face.  If that
  /// is farther than kReach, it finds another face or none.  p may lie outside the box.
  /// Cost: a look at 27 voxels.
  [[nodiscard]] std::array<Near, 2> nearest(const VoxelPoint& p, const LabelPair& labels) const;

 private:
  using Block = std::array<Label, 27>;
  using Voxel = std::array<std::int64_t, 3>;

  /// The voxel in the box nearest to p.
  [[nodiscard]] Voxel voxel_of(const VoxelPoint& p) const;
  /// The labels of 3 x 3 x 3 voxels, kExterior outside the box.
  [[nodiscard]] Block block_around(const Voxel& voxel) const;

  const VoxelLabels& volume_;
};

/// Calls visit(VoxelFace, labels below and above) for every face between two labels whose first
/// corner is one of `corners`.
template <class Visit>
void visit_interface_faces(const VoxelLabels& volume, const Box3& corners, Visit&& visit) {
  MixedCorners(volume, corners).visit([&](const MixedCorner& corner) {
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const Label below = corner.around[7U ^ 1U << axis];
      const Label above = corner.around[7];
      if (below == above || below == kExterior || above == kExterior) continue;
      visit(VoxelFace{corner.at, axis}, LabelPair{below, above});
    }
  });
}

}  // namespace mw::audit
