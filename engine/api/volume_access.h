// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is behind a Volume of the library.
#pragma once

#include "engine/mwmesh.h"
#include "io/volume/label_volume.h"

namespace mwmesh {

class Volume::Content {
 public:
  explicit Content(std::shared_ptr<const mw::io::LabelVolume> volume)
      : volume_(std::move(volume)) {}

  [[nodiscard]] const std::shared_ptr<const mw::io::LabelVolume>& volume() const { return volume_; }

 private:
  std::shared_ptr<const mw::io::LabelVolume> volume_;
};

/// The only class that looks behind a Volume.
class VolumeAccess {
 public:
  [[nodiscard]] static const mw::io::LabelVolume& labels(const Volume& volume) {
    return *volume.content_->volume();
  }
  [[nodiscard]] static std::shared_ptr<const mw::io::LabelVolume> shared(const Volume& volume) {
    return volume.content_->volume();
  }
  [[nodiscard]] static Volume wrap(std::shared_ptr<const mw::io::LabelVolume> volume) {
    return Volume(std::make_shared<const Volume::Content>(std::move(volume)));
  }
};

}  // namespace mwmesh
