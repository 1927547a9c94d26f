// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume of thick slices, seen as thin ones.
#pragma once

#include "io/volume/label_volume.h"

namespace mw::io {

/// A volume whose voxels are cut into layers as they are read: the shape is `layers` times larger,
/// the spacing as much smaller, everything else the same.
/// Thread safety: as the volume below, which must outlive it.
class LayeredVolume : public VolumeView {
 public:
  /// REQUIRES: layers from 1 to kMaxLayers (kernels/core/layers.h).
  LayeredVolume(const LabelVolume& volume, Index3 layers);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }

  /// Reads the voxels of the volume below that the box meets once, together.
  /// Memory: their labels, at most as many as out has with one voxel more along each axis.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  Index3 layers_;
  VolumeInfo info_;
};

}  // namespace mw::io
