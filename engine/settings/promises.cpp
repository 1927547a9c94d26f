// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promises out of settings, and back.
#include "engine/settings/promises.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "engine/settings/setting_table.h"
#include "kernels/quality/halved_tet.h"

namespace mw::engine {
namespace {

// Floors between which the volumes of labels are promised, as measured (engine/verify/README.md).
// Below, contractions may fold what holds a volume; above, they are refused where dust needs them.
constexpr double kLeastFloor = 0.05;
constexpr double kMostFloor = 0.3;

MeshSettings settings_of(const io::MeshPromises& promises) {
  MeshSettings out;
  out.max_distance = promises.max_distance;
  out.quality_floor = promises.quality_floor;
  out.topology = promises.interfaces ? KeptTopology::kInterfaces : KeptTopology::kLabels;
  out.surface = promises.smooth ? Surface::kSmooth : Surface::kVoxel;
  out.optimizer = promises.optimised ? Optimizer::kLocal : Optimizer::kNone;
  out.periodic = promises.periodic;
  return out;
}

}  // namespace

io::MeshPromises promises_of(const MeshSettings& settings) {
  return {.max_distance = settings.max_distance,
          .quality_floor = settings.quality_floor,
          .interfaces = settings.topology == KeptTopology::kInterfaces,
          .smooth = settings.surface == Surface::kSmooth,
          .optimised = settings.optimizer != Optimizer::kNone,
          .periodic = settings.periodic};
}

double floor_of(const io::MeshPromises& promises) {
  return halved_floor(promises.quality_floor, promises.halvings);
}

std::string why_no_volumes(const io::MeshPromises& promises) {
  if (!promises.smooth) return "--surface voxel";
  if (!promises.max_distance) return "--max-distance none";
  if (!promises.optimised) return "--optimizer none";
  if (promises.quality_floor < kLeastFloor) {
    return "--quality-floor below " + format_number(kLeastFloor);
  }
  if (promises.quality_floor > kMostFloor) {
    return "--quality-floor above " + format_number(kMostFloor);
  }
  return "";
}

std::string less_than_default(const io::MeshPromises& promises) {
  const io::MeshPromises usual = promises_of({});
  std::string out;
  const auto add = [&out](const std::string& words) { out += (out.empty() ? "" : ", ") + words; };
  if (!promises.max_distance) {
    add("no distance bound");
  } else if (*promises.max_distance > *usual.max_distance) {
    add("distance " + format_number(*promises.max_distance));
  }
  if (promises.quality_floor <= 0) {
    add("no floor");
  } else if (promises.quality_floor < usual.quality_floor) {
    add("radius ratio " + format_number(promises.quality_floor));
  }
  return out;
}

void check_promises(const io::MeshPromises& promises) {
  try {
    check(settings_of(promises));
  } catch (const Error& error) {
    throw Error(ErrorKind::kInput,
                std::string("the mesh's record of what its run promised: ") + error.what() +
                    "; no run promises this, so the file is damaged or was changed");
  }
}

}  // namespace mw::engine
