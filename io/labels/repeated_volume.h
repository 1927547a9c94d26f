// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes that show voxels several times: thick slices as thin ones, and a cell that repeats itself
// with a part of its neighbours around it.
#pragma once

#include "io/volume/label_volume.h"

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
/// beside it.  The first corner moves accordingly, everything else is the same.
/// Thread safety: as the volume below, which must outlive it.
class PeriodicVolume : public VolumeView {
 public:
  PeriodicVolume(const LabelVolume& volume, Index3 margin);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  /// Returns none, since the scores are of the cell alone.
  [[nodiscard]] const LabelScores* scores() const override { return nullptr; }

  /// Reads the part of each copy that the box meets.  Memory: the labels of the largest part.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  Index3 margin_;
  VolumeInfo info_;
};

}  // namespace mw::io
