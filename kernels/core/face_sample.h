// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sample points on the voxel faces between two labels: what the distance bound carries along.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw {

/// A sample on a voxel face, in 8 bytes: the voxel on the face's lower side, the face's axis, and
/// which of the face's quarters the sample is the centre of.
using FaceSample = std::uint64_t;

/// Largest distance of a point of a voxel face to the nearest of its four samples: sqrt(2) / 4.
inline constexpr double kSampleCoveringRadius = 0.35355339059327379;
inline constexpr unsigned kSamplesPerFace = 4;

[[nodiscard]] inline FaceSample face_sample(Index3 lower_voxel, unsigned axis, unsigned quarter,
                                            Index3 volume) {
  const std::int64_t voxel = (lower_voxel.z * volume.y + lower_voxel.y) * volume.x + lower_voxel.x;
  return (static_cast<FaceSample>(voxel) * 3 + axis) * kSamplesPerFace + quarter;
}

/// Where the sample lies.  Quarter bit 0 is the upper half along the face's first axis, bit 1 along
/// its second (axes in ascending order).
[[nodiscard]] inline Point position(FaceSample sample, Index3 volume) {
  const unsigned quarter = static_cast<unsigned>(sample % kSamplesPerFace);
  const unsigned axis = static_cast<unsigned>(sample / kSamplesPerFace % 3);
  const auto voxel = static_cast<std::int64_t>(sample / (kSamplesPerFace * 3));
  const std::array<std::int64_t, 3> v{voxel % volume.x, voxel / volume.x % volume.y,
                                      voxel / (volume.x * volume.y)};
  std::array<std::int32_t, 3> p{};
  unsigned bit = 0;
  for (unsigned i = 0; i < 3; ++i) {
    std::int64_t inside = kUnitsPerVoxel;
    if (i != axis) inside = kUnitsPerVoxel / 4 + (quarter >> bit++ & 1U) * kUnitsPerVoxel / 2;
    p[i] = static_cast<std::int32_t>(v[i] * kUnitsPerVoxel + inside);
  }
  return {p[0], p[1], p[2]};
}

}  // namespace mw
