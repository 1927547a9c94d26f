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
  Vec3 normal = Vec3::Zero();  ///< unit normal to the face's upper side
  double height = 0.0;         ///< height over the face's centre, along the normal
};

/// A plane as it is stored.  The highest bits hold the height, the next ones two coordinates of the
/// normal on the octahedron; all are signed.
using PackedPlane = std::uint32_t;

/// How the bits of a packed plane are shared out.
struct PlaneBits {
  unsigned height = 8;
  unsigned normal = 12;  ///< for each coordinate

  [[nodiscard]] constexpr double height_steps() const {  ///< steps of the height in a voxel
    return static_cast<double>((1U << height) - 2U);
  }
  [[nodiscard]] constexpr double normal_steps() const {
    return static_cast<double>((1U << (normal - 1U)) - 1U);
  }
};
/// The bits of planes that are computed from labels by filters (SourceSurface).
inline constexpr PlaneBits kFilteredBits{};
/// The bits of crossings, whose heights are along the axis of the face and good to half a unit of
/// the lattice.
inline constexpr PlaneBits kCrossingBits{.height = 12, .normal = 10};

/// The largest height, in voxels: a plane that is sampled by voxels is never farther from a face.
inline constexpr double kMaxSourceHeight = 0.5;

namespace packed_plane {
[[nodiscard]] inline std::int32_t rounded(double x) {
  return static_cast<std::int32_t>(std::floor(x + 0.5));
}
[[nodiscard]] inline double sign_of(double x) {
  return x < 0.0 ? -1.0 : 1.0;
}
}  // namespace packed_plane

/// REQUIRES: height within kMaxSourceHeight.
[[nodiscard]] inline PackedPlane pack(const SourcePlane& plane, PlaneBits bits = kFilteredBits) {
  using namespace packed_plane;
  const Vec3& n = plane.normal;
  const double sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
  double u = n[0] / sum, v = n[1] / sum;
  if (n[2] < 0.0) {
    const double folded = (1.0 - std::abs(v)) * sign_of(u);
    v = (1.0 - std::abs(u)) * sign_of(v);
    u = folded;
  }
  const auto field = [](double x, unsigned width) {
    return static_cast<std::uint32_t>(rounded(x)) & ((1U << width) - 1U);
  };
  return field(plane.height * bits.height_steps(), bits.height) << (2U * bits.normal) |
         field(u * bits.normal_steps(), bits.normal) << bits.normal |
         field(v * bits.normal_steps(), bits.normal);
}

[[nodiscard]] inline SourcePlane unpack(PackedPlane packed, PlaneBits bits = kFilteredBits) {
  using namespace packed_plane;
  // A shift to the left moves a field's sign to the top, one to the right spreads it.
  const auto field = [packed](unsigned from_top, unsigned width) {
    return static_cast<double>(static_cast<std::int32_t>(packed << from_top) >> (32U - width));
  };
  double u = field(bits.height, bits.normal) / bits.normal_steps();
  double v = field(bits.height + bits.normal, bits.normal) / bits.normal_steps();
  const double w = 1.0 - std::abs(u) - std::abs(v);
  if (w < 0.0) {
    const double folded = (1.0 - std::abs(v)) * sign_of(u);
    v = (1.0 - std::abs(u)) * sign_of(v);
    u = folded;
  }
  const Vec3 n(u, v, w);
  return {n / n.norm(), field(0, bits.height) / bits.height_steps()};
}

}  // namespace mw
