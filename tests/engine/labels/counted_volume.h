// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume that counts what is read of it.
#pragma once

#include <atomic>

#include "io/volume/label_volume.h"

namespace mw::engine::test {

/// Counts reads; may say that it has chunks.
class CountedVolume : public io::VolumeView {
 public:
  explicit CountedVolume(const io::LabelVolume& volume, Index3 chunk = {0, 0, 0})
      : VolumeView(volume), info_(volume.info()) {
    info_.chunk = chunk;
  }
  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    voxels_ += box.voxels();
    below().read(box, out);
  }
  [[nodiscard]] std::int64_t voxels() const { return voxels_; }

 private:
  io::VolumeInfo info_;
  mutable std::atomic<std::int64_t> voxels_ = 0;
};

}  // namespace mw::engine::test
