// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gives a volume further names of labels.
#pragma once

#include <memory>
#include <utility>

#include "io/names/label_names.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// The volume with these names added to its own; where both name a label, these win.
/// Thread safety: as the volume below.
class NamedVolume : public VolumeView {
 public:
  NamedVolume(std::shared_ptr<const LabelVolume> volume, const LabelNames& names)
      : VolumeView(std::move(volume)), info_(below().info()) {
    info_.names = info_.names.merged_with(names);
  }

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override { below().read(box, out); }

 private:
  VolumeInfo info_;
};

}  // namespace mw::io
