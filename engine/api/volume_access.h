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
  /// ERRORS: Error(kUsage) for a volume that was moved from; the same holds for shared().
  [[nodiscard]] static const mw::io::LabelVolume& labels(const Volume& volume) {
    return *shared(volume);
  }
  [[nodiscard]] static const std::shared_ptr<const mw::io::LabelVolume>& shared(
      const Volume& volume) {
    if (volume.content_ != nullptr) return volume.content_->volume();
    throw Error(ErrorKind::kUsage, "volume: it was moved from, so there is nothing in it");
  }
  [[nodiscard]] static Volume wrap(std::shared_ptr<const mw::io::LabelVolume> volume) {
    return Volume(std::make_shared<const Volume::Content>(std::move(volume)));
  }
};

}  // namespace mwmesh
