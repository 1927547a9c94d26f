// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume whose reading can be stopped.
#pragma once

#include <functional>

#include "io/volume/volume_view.h"

namespace mw::engine {

/// Calls stop(), which may throw, before each read.
class StoppableVolume : public io::VolumeView {
 public:
  StoppableVolume(const io::LabelVolume& volume, std::function<void()> stop)
      : VolumeView(volume), stop_(std::move(stop)) {}

  void read(const Box3& box, std::span<RawLabel> out) const override {
    stop_();
    below().read(box, out);
  }

 private:
  std::function<void()> stop_;
};

}  // namespace mw::engine
