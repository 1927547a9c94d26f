// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The plane that a voxel face of an interface stands for, in four bytes.
#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/core/metric.h"

namespace mw {

/// The plane on which the interface is believed to lie near a voxel face, in voxels.
struct SourcePlane {
  Vec3 normal = Vec3::Zero();  ///< of length one, to the face's upper side
  double height = 0.0;         ///< of the plane over the face's centre, along the normal
};

/// A plane as it is stored: from the highest bit on the height (8 bits, signed), then two
/// coordinates of the normal on the octahedron (12 bits each, signed).
using PackedPlane = std::uint32_t;

/// The largest height, in voxels: a plane that is sampled by voxels is never farther from a face.
inline constexpr double kMaxSourceHeight = 0.5;

namespace packed_plane {
inline constexpr double kHeightSteps = 254.0;  ///< in a voxel
inline constexpr double kNormalSteps = 2047.0;

[[nodiscard]] inline std::int32_t rounded(double x) {
  return static_cast<std::int32_t>(std::floor(x + 0.5));
}
[[nodiscard]] inline double sign_of(double x) {
  return x < 0.0 ? -1.0 : 1.0;
}
}  // namespace packed_plane

/// REQUIRES: height within kMaxSourceHeight.
[[nodiscard]] inline PackedPlane pack(const SourcePlane& plane) {
  using namespace packed_plane;
  const Vec3& n = plane.normal;
  const double sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
  double u = n[0] / sum, v = n[1] / sum;
  if (n[2] < 0.0) {
    const double folded = (1.0 - std::abs(v)) * sign_of(u);
    v = (1.0 - std::abs(u)) * sign_of(v);
    u = folded;
  }
  const auto bits = [](std::int32_t x, unsigned mask) {
    return static_cast<std::uint32_t>(x) & mask;
  };
  return bits(rounded(plane.height * kHeightSteps), 0xffU) << 24 |
         bits(rounded(u * kNormalSteps), 0xfffU) << 12 | bits(rounded(v * kNormalSteps), 0xfffU);
}

[[nodiscard]] inline SourcePlane unpack(PackedPlane packed) {
  using namespace packed_plane;
  // A shift to the left moves a field's sign to the top, one to the right spreads it.
  const auto field = [packed](unsigned from_top, unsigned bits) {
    return static_cast<double>(static_cast<std::int32_t>(packed << from_top) >> (32U - bits));
  };
  double u = field(8, 12) / kNormalSteps, v = field(20, 12) / kNormalSteps;
  const double w = 1.0 - std::abs(u) - std::abs(v);
  if (w < 0.0) {
    const double folded = (1.0 - std::abs(v)) * sign_of(u);
    v = (1.0 - std::abs(u)) * sign_of(v);
    u = folded;
  }
  const Vec3 n(u, v, w);
  return {n / n.norm(), field(0, 8) / kHeightSteps};
}

}  // namespace mw
