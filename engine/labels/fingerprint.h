// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A number that tells whether two volumes hold the same labels.
#pragma once

#include <atomic>

#include "io/volume/label_volume.h"

namespace mw::engine {

/// A volume that takes a fingerprint of what is read through it: a sum over voxels, which does not
/// depend on the boxes they are read in.  It is of the content, not of name, size and time of the
/// file: a copy or a conversion is the same input, a file edited in place is not; and all labels
/// are read once at the start of a run anyway.  It guards against mistakes, not against malice.
class FingerprintVolume : public io::VolumeView {
 public:
  using VolumeView::VolumeView;
  void read(const Box3& box, std::span<RawLabel> out) const override;

  /// Returns the sum over a box alone, which is read for it and not added to sum().
  [[nodiscard]] std::uint64_t of(const Box3& box) const;

  /// Returns the sum over what was read here; add() takes that of what another process has read.
  [[nodiscard]] std::uint64_t sum() const { return sum_; }
  void add(std::uint64_t sum) { sum_ += sum; }

  /// Returns the fingerprint as 16 hexadecimal digits.  REQUIRES: every voxel has been read exactly
  /// once, here or by another process.
  [[nodiscard]] std::string text() const;

 private:
  mutable std::atomic<std::uint64_t> sum_ = 0;
};

}  // namespace mw::engine
