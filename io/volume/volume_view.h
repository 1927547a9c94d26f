// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume that is read through another one.
#pragma once

#include "io/volume/label_volume.h"

namespace mw::io {

/// Everything as the volume below has it, which must outlive it; read() is the heir's.
class VolumeView : public LabelVolume {
 public:
  explicit VolumeView(const LabelVolume& volume) : volume_(&volume) {}

  [[nodiscard]] const VolumeInfo& info() const override { return volume_->info(); }
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override {
    return volume_->buffer_bytes(threads);
  }
  void drop_buffers() const override { volume_->drop_buffers(); }

 protected:
  [[nodiscard]] const LabelVolume& below() const { return *volume_; }

 private:
  const LabelVolume* volume_;
};

}  // namespace mw::io
