// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume whose labels have more names than its file gives them.
#pragma once

#include <memory>

#include "io/volume/label_volume.h"

namespace mw::io {

/// The volume with these names added to its own; where both name a label, these win.
/// Thread safety: as the volume below.
class NamedVolume : public LabelVolume {
 public:
  NamedVolume(std::unique_ptr<LabelVolume> volume, const LabelNames& names)
      : volume_(std::move(volume)), info_(volume_->info()) {
    info_.names = info_.names.merged_with(names);
  }

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override { volume_->read(box, out); }
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override {
    return volume_->buffer_bytes(threads);
  }
  void drop_buffers() const override { volume_->drop_buffers(); }

 private:
  std::unique_ptr<LabelVolume> volume_;
  VolumeInfo info_;
};

}  // namespace mw::io
