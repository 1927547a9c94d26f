// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tells the grey values of an image from labels while voxels are read.
#pragma once

#include <atomic>
#include <cstdint>

#include "io/labels/label_table.h"
#include "io/volume/label_volume.h"

namespace mw::engine {

/// A volume that looks at each voxel between its neighbours along x in the rows that are read.  In
/// an image nearly every voxel differs from both, and by little; labels fill runs of voxels, and
/// where they do not, as in noise, their numbers are far apart.
class TextureVolume : public io::VolumeView {
 public:
  using VolumeView::VolumeView;
  void read(const Box3& box, std::span<RawLabel> out) const override;

  /// Returns whether what was read is an image by all of these: it has at least 16 values; more
  /// voxels differ from both neighbours than from one; each value is, on average, at least twice
  /// larger or smaller than both (which ramps and numbered voxels are not); and there the steps to
  /// the neighbours are smaller, on average, than a fifth of the number of values, where noise with
  /// labels from 0 on has more than a third.  One far value does not change that.
  /// REQUIRES: the table has all labels that were read.
  [[nodiscard]] bool is_image(const io::LabelTable& table) const;

 private:
  void look_at(std::span<const RawLabel> row) const;

  mutable std::atomic<std::uint64_t> singles_ = 0;  ///< voxels that differ from both neighbours
  mutable std::atomic<std::uint64_t> ends_ = 0;     ///< voxels that differ from one
  mutable std::atomic<std::uint64_t> peaks_ = 0;    ///< singles above or below both
  mutable std::atomic<std::uint64_t> steps_ = 0;    ///< the sum over peaks of both differences
};

}  // namespace mw::engine
