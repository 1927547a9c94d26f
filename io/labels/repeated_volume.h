// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes that show voxels several times: thick slices as thin ones, and a cell that repeats itself
// with a part of its neighbours around it.
#pragma once

#include <optional>

#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"

namespace mw::io {

/// A volume whose voxels are cut into layers as they are read: the shape is `layers` times larger,
/// the spacing as much smaller, everything else the same.
/// Thread safety: as the volume below, which must outlive it.
class LayeredVolume : public VolumeView {
 public:
  /// REQUIRES: layers from 1 to kMaxLayers (kernels/core/lattice.h).
  LayeredVolume(const LabelVolume& volume, Index3 layers);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }

  /// Reads the voxels of the volume below that the box meets once, together.
  /// Memory: their labels, at most as many as out has with one voxel more along each axis.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  Index3 layers_;
  VolumeInfo info_;
};

/// A volume with `margin` more voxels on both sides of each axis, which are those of its copies
/// beside it, and so are scores.  The first corner moves accordingly, everything else is the same.
/// Thread safety: as the volume below, which must outlive it.
class PeriodicVolume : public VolumeView {
 public:
  /// REQUIRES: margins are whole voxels of scores, where there are scores.
  PeriodicVolume(const LabelVolume& volume, Index3 margin);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  [[nodiscard]] const LabelScores* scores() const override { return scores_ ? &*scores_ : nullptr; }

  /// Reads the part of each copy that the box meets.  Memory: the labels of the largest part.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  class PeriodicScores : public LabelScores {
   public:
    PeriodicScores(const LabelScores& cell, Index3 margin) : cell_(cell), margin_(margin) {}
    [[nodiscard]] Index3 shape() const override { return cell_.shape() + margin_ + margin_; }
    [[nodiscard]] std::size_t labels() const override { return cell_.labels(); }
    void read_scores(RawLabel label, const Box3& box, std::span<double> out) const override;

   private:
    const LabelScores& cell_;
    Index3 margin_;
  };

  Index3 margin_;
  VolumeInfo info_;
  std::optional<PeriodicScores> scores_;
};

}  // namespace mw::io
