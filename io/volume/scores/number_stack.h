// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of numbers that lie in one file.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "io/volume/label_volume.h"

namespace mw::io {

/// A file with several numbers a voxel, as it is opened where OpenOptions::values asks for them.
/// Everything except parts() is that of the first part.
class NumberStack : public VolumeView {
 public:
  /// REQUIRES: at least one part; all of the same shape and place, and NumberVolumes.
  explicit NumberStack(std::vector<std::shared_ptr<const LabelVolume>> parts)
      : VolumeView(parts.front()), parts_(std::move(parts)) {}

  [[nodiscard]] const std::vector<std::shared_ptr<const LabelVolume>>& parts() const {
    return parts_;
  }
  void read(const Box3& box, std::span<RawLabel> out) const override { below().read(box, out); }

 private:
  std::vector<std::shared_ptr<const LabelVolume>> parts_;
};

}  // namespace mw::io
