// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The slices on which the frames of a DICOM file lie.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/volume/dicom/dicom_segments.h"
#include "io/volume/volume_space.h"

namespace mw::io {

/// Equal steps along the normal of the frames' plane, each of which is a slice.
/// The step is the Spacing Between Slices that the file states where frames agree with it: where
/// each lies within a twentieth of a step of a multiple of it.  Coordinates may be rounded and the
/// spacing, too, by up to a hundredth; then the step is the one that fits the frames best.  Where
/// no spacing is stated, or frames contradict it, the step is the Slice Thickness if this is the
/// least distance of two slices, else the distance that most neighbours have (the median).
class SliceGrid {
 public:
  /// REQUIRES: is_sound(dicom).
  /// ERRORS: mw::Error(kInput) naming the frames that lie off all multiples of the step, or beside
  /// the others; the file is called `file`.
  SliceGrid(const DicomSegments& dicom, const std::string& file);

  /// Returns how many slices there are from the first to the last frame.
  [[nodiscard]] std::int64_t count() const { return count_; }
  /// Returns the slice of a frame.
  [[nodiscard]] std::int64_t slice(std::size_t frame) const { return slices_[frame]; }
  /// Returns how many of the slices have no frame.
  [[nodiscard]] std::int64_t empty() const;
  [[nodiscard]] const Vector3& normal() const { return normal_; }
  /// Returns the centre of the first voxel of slice 0.
  [[nodiscard]] const Vector3& first() const { return first_; }
  [[nodiscard]] double step() const { return step_; }

 private:
  void check_beside(const DicomSegments& dicom, const std::string& file) const;

  Vector3 normal_;
  double step_ = 0;
  std::vector<std::int64_t> slices_;  ///< those of the frames
  std::int64_t count_ = 0;
  Vector3 first_{};
};

}  // namespace mw::io
