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
  double height = 0.0;         ///< height over the face's centre, along what PlaneForm says
};

/// A plane as it is stored.  The highest bits hold the height, the next ones two coordinates of the
/// normal on the octahedron; all are signed.
using PackedPlane = std::uint32_t;

/// The largest height of planes that are computed from labels, in voxels: a plane that is sampled
/// by voxels is never farther from a face.
inline constexpr double kMaxSourceHeight = 0.5;

/// What the heights of planes mean, and how the bits of a packed plane are shared out.
struct PlaneForm {
  bool along_axis = false;          ///< heights are along the axis of the face, not the normal
  double reach = kMaxSourceHeight;  ///< the largest height, in voxels
  unsigned height_bits = 8;
  unsigned normal_bits = 12;  ///< for each coordinate

  friend constexpr bool operator==(const PlaneForm&, const PlaneForm&) = default;
  [[nodiscard]] constexpr double height_steps() const {  ///< steps of the height in a voxel
    return static_cast<double>((1U << (height_bits - 1U)) - 1U) / reach;
  }
  [[nodiscard]] constexpr double normal_steps() const {
    return static_cast<double>((1U << (normal_bits - 1U)) - 1U);
  }
};
/// The form of planes that are computed from labels by filters (SourceSurface).
inline constexpr PlaneForm kFilteredForm{};

namespace packed_plane {
[[nodiscard]] inline std::int32_t rounded(double x) {
  return static_cast<std::int32_t>(std::floor(x + 0.5));
}
[[nodiscard]] inline double sign_of(double x) {
  return x < 0.0 ? -1.0 : 1.0;
}
}  // namespace packed_plane

/// REQUIRES: height within the reach of the form.
[[nodiscard]] inline PackedPlane pack(const SourcePlane& plane,
                                      const PlaneForm& form = kFilteredForm) {
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
  return field(plane.height * form.height_steps(), form.height_bits) << (2U * form.normal_bits) |
         field(u * form.normal_steps(), form.normal_bits) << form.normal_bits |
         field(v * form.normal_steps(), form.normal_bits);
}

[[nodiscard]] inline SourcePlane unpack(PackedPlane packed, const PlaneForm& form = kFilteredForm) {
  using namespace packed_plane;
  // A shift to the left moves a field's sign to the top, one to the right spreads it.
  const auto field = [packed](unsigned from_top, unsigned width) {
    return static_cast<double>(static_cast<std::int32_t>(packed << from_top) >> (32U - width));
  };
  double u = field(form.height_bits, form.normal_bits) / form.normal_steps();
  double v = field(form.height_bits + form.normal_bits, form.normal_bits) / form.normal_steps();
  const double w = 1.0 - std::abs(u) - std::abs(v);
  if (w < 0.0) {
    const double folded = (1.0 - std::abs(v)) * sign_of(u);
    v = (1.0 - std::abs(u)) * sign_of(v);
    u = folded;
  }
  const Vec3 n(u, v, w);
  return {n / n.norm(), field(0, form.height_bits) / form.height_steps()};
}

}  // namespace mw
