// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From voxels to the world and back.
#include "io/volume/volume_space.h"

#include <cmath>

namespace mw::io {
const char* name(WorldFrame frame) {
  return frame == WorldFrame::kRas ? "ras" : frame == WorldFrame::kLps ? "lps" : "own";
}

std::optional<double> nm_in(std::string_view unit) {
  if (unit == "nm") return 1;
  if (unit == "um") return 1e3;
  if (unit == "mm") return 1e6;
  if (unit == "m") return 1e9;
  return std::nullopt;
}

bool is_upright(const VolumeSpace& space) {
  return space.axes == VolumeSpace{}.axes;
}

bool is_mirrored(const VolumeSpace& space) {
  return determinant(space.axes[0], space.axes[1], space.axes[2]) < 0;
}

Vector3 to_corner(const VolumeSpace& space, const Vector3& world) {
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    double along = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      along += space.axes[i][k] * (world[k] - space.origin[k]);
    }
    out[i] = along / space.spacing[i];
  }
  return out;
}

VolumeSpace in_frame(VolumeSpace space, WorldFrame frame) {
  if (space.frame == frame || space.frame == WorldFrame::kOwn || frame == WorldFrame::kOwn) {
    return space;
  }
  for (const std::size_t k : {0U, 1U}) {
    for (Vector3& axis : space.axes) axis[k] = 0 - axis[k];
    space.origin[k] = 0 - space.origin[k];
  }
  space.frame = frame;
  return space;
}

VolumeSpace moved_to(const VolumeSpace& space, Index3 first) {
  VolumeSpace out = space;
  out.origin = to_world(space, {static_cast<double>(first.x), static_cast<double>(first.y),
                                static_cast<double>(first.z)});
  return out;
}

bool is_same_place(const VolumeSpace& a, const VolumeSpace& b) {
  constexpr double kTolerance = 1e-3;  // voxels
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = a.spacing[axis] * a.axes[axis][k] - b.spacing[axis] * b.axes[axis][k];
      const double origin = a.origin[k] - b.origin[k];
      if (!(std::abs(step) <= kTolerance * a.spacing[axis])) return false;
      if (!(std::abs(origin) <= kTolerance * a.spacing[axis])) return false;
    }
  }
  return true;
}

}  // namespace mw::io
