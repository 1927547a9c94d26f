// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The input's interface: its voxel faces between labels, and sample points on them.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/audit/distance_shapes.h"
#include "kernels/audit/distance_trees.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// The face between voxel `upper` and the one below it along `axis`.
struct VoxelFace {
  std::array<std::uint32_t, 3> upper{};
  std::uint32_t axis = 0;
};

[[nodiscard]] Extent extent_of(const VoxelFace& face);
/// Labels below and above.
[[nodiscard]] LabelPair labels_of(const VoxelFace& face, const VoxelLabels& volume);

/// Every face between two labels, in the order of a space-filling curve.
/// Errors: kResource above 2^20 voxels along an axis or 2^32 - 1 faces.
[[nodiscard]] std::vector<VoxelFace> interface_faces(const VoxelLabels& volume);

/// A corner of voxels where labels meet: the labels of the eight voxels around it, bit k of the
/// index for the upper side of axis k; kExterior outside the box.
struct MixedCorner {
  std::array<std::uint32_t, 3> at{};
  std::array<Label, 8> around{};
};

/// Visits every corner around which there are two labels or more, x fastest.
class MixedCorners {
 public:
  /// REQUIRES: at least one voxel; `volume` outlives this.
  explicit MixedCorners(const VoxelLabels& volume) : volume_(volume) {}

  template <class Visit>
  void visit(Visit&& visit) const {
    const Index3 s = volume_.shape;
    for (std::int64_t z = 0; z <= s.z; ++z) {
      for (std::int64_t y = 0; y <= s.y; ++y) visit_row(y, z, visit);
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
    const auto count = static_cast<std::size_t>(volume_.shape.x);
    Label last = row[0][0];
    bool last_is_uniform = true;
    for (std::size_t x = 0; x <= count; ++x) {
      const std::size_t i = x < count ? x : count - 1;
      const Label label = row[0][i];
      const bool is_uniform = label == row[1][i] && label == row[2][i] && label == row[3][i];
      const bool is_mixed = !is_uniform || !last_is_uniform || label != last;
      if (is_mixed) visit(corner({static_cast<std::int64_t>(x), y, z}, row));
      last = label;
      last_is_uniform = is_uniform;
    }
  }

  const VoxelLabels& volume_;
};

/// The nearest voxel faces of two labels, when they are close.
class CloseFaces {
 public:
  static constexpr double kReach = 1;  ///< voxels

  /// REQUIRES: at least one voxel; `volume` outlives this.
  explicit CloseFaces(const VoxelLabels& volume) : volume_(volume) {}

  /// For each label the squared distance from p to its nearest face; some larger number when that
  /// is farther than kReach.  p may lie outside the box.
  /// Cost: a look at 27 voxels.
  [[nodiscard]] std::array<double, 2> squared_distances(const VoxelPoint& p,
                                                        const LabelPair& labels) const;

 private:
  using Block = std::array<Label, 27>;
  using Voxel = std::array<std::int64_t, 3>;

  /// The voxel in the box nearest to p.
  [[nodiscard]] Voxel voxel_of(const VoxelPoint& p) const;
  /// 3 x 3 x 3 voxels; kExterior outside the box.
  [[nodiscard]] Block block_around(const Voxel& voxel) const;

  const VoxelLabels& volume_;
};

/// How densely a voxel face is sampled.
enum class FaceSampling {
  kNine,  ///< corners, middles of edges, centre
  kFive,  ///< corners and centre
};

[[nodiscard]] constexpr std::uint32_t samples_a_face(FaceSampling sampling) {
  return sampling == FaceSampling::kNine ? 9 : 5;
}

/// Largest distance in voxels from a point of a face to the nearest sample on it: half the diagonal
/// of a quarter, rounded up; from the middle of an edge to the centre.
[[nodiscard]] constexpr double covering_radius(FaceSampling sampling) {
  return sampling == FaceSampling::kNine ? 0.354 : 0.5;
}

/// A label at a sample, and how many of its boundary's faces have this sample.
struct TouchedLabel {
  Label label = 0;
  std::uint32_t faces = 0;
};

/// Labels whose boundary has a sample, each once, in the order they are met.
class TouchedLabels {
 public:
  void clear() { size_ = 0; }
  void add(Label label) {
    for (std::size_t i = 0; i < size_; ++i) {
      if (labels_[i].label != label) continue;
      ++labels_[i].faces;
      return;
    }
    labels_[size_++] = {label, 1};
  }
  [[nodiscard]] std::span<const TouchedLabel> get() const {
    return std::span(labels_).first(size_);
  }

 private:
  std::array<TouchedLabel, 8> labels_{};
  std::size_t size_ = 0;
};

/// Labels whose boundary has the sample half a voxel up from the corner along the axes in `half`.
void touch(const MixedCorner& corner, unsigned half, TouchedLabels& out);

/// Calls visit(VoxelPoint, span<const TouchedLabel>) once for every sample point on the interface,
/// however many faces share it.
template <class Visit>
void visit_face_samples(const VoxelLabels& volume, FaceSampling sampling, Visit&& visit) {
  TouchedLabels touched;
  MixedCorners(volume).visit([&](const MixedCorner& corner) {
    for (unsigned half = 0; half < 7; ++half) {
      if (sampling == FaceSampling::kFive && std::popcount(half) == 1) continue;
      touched.clear();
      touch(corner, half, touched);
      if (touched.get().empty()) continue;
      VoxelPoint p{};
      for (unsigned k = 0; k < 3; ++k) p[k] = corner.at[k] + 0.5 * (half >> k & 1U);
      visit(p, touched.get());
    }
  });
}

}  // namespace mw::audit
