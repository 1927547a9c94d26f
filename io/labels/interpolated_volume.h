// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume of thick slices, seen as one of thin slices with labels between them
// (--interpolate-slices).
#pragma once

#include <optional>

#include "io/labels/slice_distances.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// What was done.
struct SliceFacts {
  int axis = 2;             ///< along which slices follow each other: 0 for x, 1 for y, 2 for z
  std::int64_t slices = 0;  ///< how many there were
  std::int64_t layers = 1;  ///< how many thin slices stand for each
};

/// Returns the slices of the thickest voxel edge, the last one of several.  Layers are those that
/// the lattice would have (kernels/core/lattice.h).
[[nodiscard]] SliceFacts slices_of(const VolumeInfo& volume);

/// Returns the volume that InterpolatedVolume shows.
/// ERRORS: mw::Error(kUsage) when slices are not twice as thick as voxels are wide, rounded; when
/// there is one slice only.
[[nodiscard]] VolumeInfo interpolated_info(const VolumeInfo& volume);

/// Cuts each slice along the axis of the thickest edge into `layers` thin ones.  A slice is taken
/// as a sample of its middle.  A pixel with one label in two slices that follow each other has it
/// between them, too; with two labels it has the first up to some place, where lower_margin()
/// (io/labels/slice_gap.h) is 0, and from there on the second; a tie goes to the nearer slice.
/// Beyond the middles of the first and the last slice their labels go on.
///
/// ENSURES: the thin slice in the middle of each slice, of two the first, has that slice's labels.
/// So a label keeps all its parts, none falls apart into several, and no label is where none of
/// both slices has it.  What read() gives depends on the labels within SliceSteps::reach() of a
/// pixel, in four slices: not on the box.
/// Memory: read() takes up to kReadBytes.
/// Thread safety: as the volume below, which must outlive it.
class InterpolatedVolume : public VolumeView {
 public:
  static constexpr std::uint64_t kReadBytes = std::uint64_t{8} << 20U;

  /// ERRORS: those of interpolated_info().
  explicit InterpolatedVolume(const LabelVolume& volume);

  [[nodiscard]] const SliceFacts& facts() const { return facts_; }
  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override {
    return below().buffer_bytes(threads) + static_cast<std::uint64_t>(threads) * kReadBytes;
  }
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  class Part;

  SliceFacts facts_;
  VolumeInfo info_;
  SliceSteps steps_;
  double thickness_;  ///< of slices, in widths of the finest voxel
};

}  // namespace mw::io
