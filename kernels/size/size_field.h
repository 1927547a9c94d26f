// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long edges may be, label by label and place by place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/core/label.h"
#include "kernels/core/metric.h"

namespace mw {

/// Finds squared distances from each cube of a grid to the nearest marked one.  Cubes are closed
/// boxes, so that neighbours are at 0 too.  squared is 0 at marked cubes, infinity at others, and x
/// fastest; the result replaces it, infinity when nothing is marked.  edges are those of a cube.
/// Cost: a few comparisons a cube, whatever is marked; one line of scratch.
void spread_squared_gaps(Index3 cubes, const Vec3& edges, std::span<float> squared);

/// Limits on the edges of a mesh.  Each label that is listed has a limit of its own, and around the
/// label is one that grows with the distance.
///
/// The volume is cut into cubes of cube_voxels() an axis, single voxels where the volume is small.
/// At a place in cube C the limit is the least of H + gradation * d over all listed labels: H is
/// the label's own, d the distance between C and the nearest cube that has voxels of it (0 for
/// neighbours), from box to box.  So it is never above H + gradation * distance to the label, and
/// below that by no more than gradation times two cubes.  An edge keeps to the limits at its ends
/// and to those of the labels around it.
///
/// Lengths are those of a Metric.  Thread safety: const members from many threads.
/// Memory: 4 bytes a cube; while it is made 16.
class SizeField {
 public:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  /// Contraction makes no edge longer than its limit; moves, flips and inner vertices may make one
  /// this many times as long.  Without that room a vertex whose edges have the length that
  /// contraction stops at could not go to where the surface is.
  static constexpr double kStretch = 1.2;

  /// A field that limits nothing.
  SizeField() = default;
  /// label_limits has the limit of each dense label, kNoLimit if it is not listed.  by_voxel:
  /// limit_voxel() will tell what is asked in all labels.  No voxel is known at first.
  SizeField(Index3 volume, const Metric& metric, std::vector<double> label_limits, double gradation,
            bool by_voxel = false);

  /// Edge of the cubes of such a volume in voxels: the least of 1, 2, 4 and 8 that leaves at most
  /// 2^21 cubes, else 8.
  [[nodiscard]] static std::int64_t cube_voxels(Index3 volume);

  /// The bytes that a field takes while it is made.
  [[nodiscard]] static std::uint64_t making_bytes(Index3 volume);

  [[nodiscard]] bool limits() const { return !values_.empty(); }

  /// Takes the labels of the voxels of a box, x fastest.  Boxes that share no cube may come from
  /// several threads at once; disjoint boxes that begin at multiples of 8 share none.
  void add(const Box3& box, std::span<const Label> voxels);
  /// Limits a voxel, whatever its label.  Thread safety: as add().
  void limit_voxel(Index3 voxel, double limit);
  /// Rounds a limit down to one of few, which is at most a twentieth less.  REQUIRES: the limit is
  /// finite, and not much less than a voxel, since each step on the way down is a twentieth.
  [[nodiscard]] static double rung_below(double limit);
  /// Makes the limits hold for moves, flips and inner vertices as they are.
  void allow_no_stretch() { stretch_ = 1.0; }
  [[nodiscard]] double stretch() const { return stretch_; }
  /// Finds the limits, once all voxels are known.  Where more than 64 limits differ, those around
  /// labels are rounded down to 64 or fewer, by as little as that takes and by a twentieth at most;
  /// of_label() stays.  Cost: some 50 ns a cube and limit.
  void spread();

  /// Gives the cubes of copies around a cell, of a volume that repeats itself, the limits of the
  /// cell's voxels.  The volume is the cell with a margin on both sides of each axis.
  /// REQUIRES: spread() was not called.
  void repeat_cell(Index3 cell, Index3 margin);
  /// Returns the field for places relative to the cell; along axes with a margin they may be in any
  /// copy of it.  REQUIRES: spread() was called.
  [[nodiscard]] SizeField around_cell(Index3 cell, Index3 margin) const;

  /// The limit at a place, without those of labels.  A place outside the volume, where a vertex may
  /// be considered before it is refused, has the limit of the nearest cube.
  /// REQUIRES: limits(), spread() was called.
  [[nodiscard]] double at(Point p) const {
    if (is_around_cell_) p = in_volume(p);
    return values_[row(cube_at(p.x, cubes_.x), cube_at(p.y, cubes_.y), cube_at(p.z, cubes_.z))];
  }
  /// Appends the limits of all cubes that a box meets, in raster order.
  /// REQUIRES: the box is inside the volume and not empty.
  void append_limits(const Box3& box, std::vector<float>& out) const {
    for_each_index(cells_of(box, {cube_, cube_, cube_}),
                   [&](Index3 c) { out.push_back(values_[row(c.x, c.y, c.z)]); });
  }
  /// The least limit of any place or label; shorter edges need not be looked at.
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double of_label(Label sided) const {
    const Label label = without_side(sided);
    return label < label_limits_.size() ? label_limits_[label] : kNoLimit;
  }
  /// Has the label a limit of its own, or is each voxel told one?
  [[nodiscard]] bool is_asked(Label label) const {
    return by_voxel_ || of_label(label) != kNoLimit;
  }
  /// May the start mesh have a cell of 2^level voxels of this label there, with edges between any
  /// of its corners?  Single voxels are always allowed.
  [[nodiscard]] bool allows_cell(Index3 lo, int level, Label label) const;

 private:
  /// The far side of the volume belongs to the last cube.
  [[nodiscard]] std::int64_t cube_at(std::int32_t units, std::int64_t cubes) const {
    return std::clamp<std::int64_t>(units >> cube_shift_, 0, cubes - 1);
  }
  [[nodiscard]] std::size_t row(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * cubes_.y + y) * cubes_.x + x);
  }

  [[nodiscard]] Point in_volume(Point p) const;

  std::int64_t cube_ = 1;  ///< edge in voxels
  int cube_shift_ = 0;     ///< from lattice units to cubes
  Index3 cubes_;
  Vec3 cube_edges_ = Vec3::Zero();
  double voxel_diagonal_ = 0.0;
  std::vector<double> label_limits_;
  double gradation_ = 0.0;
  bool by_voxel_ = false;
  double stretch_ = kStretch;
  bool is_around_cell_ = false;
  Index3 cell_, margin_;       ///< see around_cell()
  double least_ = 0.0;         ///< known after spread()
  std::vector<float> values_;  ///< limit of each cube, rounded down; before spread() of its voxels
};

}  // namespace mw
