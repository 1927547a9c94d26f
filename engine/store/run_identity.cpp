// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Settings to lines of text.
#include "engine/store/run_identity.h"

#include <array>

#include "engine/settings/setting_table.h"
#include "io/file/errors.h"

namespace mw::engine {
namespace {

std::string triple(const std::array<double, 3>& v) {
  return io::text(v[0], ",", v[1], ",", v[2]);
}

std::string volume_text(const io::VolumeInfo& volume) {
  const Index3 shape = volume.shape;
  const io::VolumeSpace& space = volume.space;
  return io::text("shape = ", shape.x, ",", shape.y, ",", shape.z, "\n",                    //
                  "type = ", io::name(volume.type), volume.scaled ? ", scaled" : "", "\n",  //
                  "spacing = ", triple(space.spacing), "\n",                                //
                  "axes = ", triple(space.axes[0]), " ", triple(space.axes[1]), " ",
                  triple(space.axes[2]), "\n",  //
                  "origin = ", triple(space.origin), "\n");
}

}  // namespace

std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& settings) {
  std::string out = volume_text(volume);
  for (const Setting& setting : setting_table()) {
    const std::string value = setting.text(settings);
    out += setting.name + " = " + (value.empty() ? "none" : value) + "\n";
  }
  return out;
}

}  // namespace mw::engine
