// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sample points on the voxel faces between two labels: what the distance bound carries along.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw {

/// A sample on a voxel face, in 8 bytes: from the highest bit on z, y and x (20 bits each) of the
/// voxel on the face's lower side, the face's axis (2 bits), and which of the face's quarters the
/// sample is the centre of (2 bits).
using FaceSample = std::uint64_t;

/// Largest distance of a point of a voxel face to the nearest of its four samples: sqrt(2) / 4.
inline constexpr double kSampleCoveringRadius = 0.35355339059327379;
inline constexpr unsigned kSamplesPerFace = 4;
/// Voxels along an axis that a sample can number.
inline constexpr std::int64_t kMaxSampledVoxels = 1 << 20;

[[nodiscard]] inline FaceSample face_sample(Index3 lower_voxel, unsigned axis, unsigned quarter) {
  return static_cast<FaceSample>(lower_voxel.z) << 44 |
         static_cast<FaceSample>(lower_voxel.y) << 24 |
         static_cast<FaceSample>(lower_voxel.x) << 4 | axis << 2 | quarter;
}

/// Where the sample lies.  Quarter bit 0 is the upper half along the face's first axis, bit 1 along
/// its second (axes in ascending order).
[[nodiscard]] inline Point position(FaceSample sample) {
  constexpr FaceSample kCoordinate = kMaxSampledVoxels - 1;
  constexpr std::int32_t kQuarter = kUnitsPerVoxel / 4, kHalf = kUnitsPerVoxel / 2;
  const auto axis = static_cast<unsigned>(sample >> 2 & 3U);
  const auto first = kQuarter + static_cast<std::int32_t>(sample & 1U) * kHalf;
  const auto second = kQuarter + static_cast<std::int32_t>(sample >> 1 & 1U) * kHalf;
  const auto base = [sample](unsigned shift) {
    return static_cast<std::int32_t>(sample >> shift & kCoordinate) * kUnitsPerVoxel;
  };
  return {base(4) + (axis == 0 ? kUnitsPerVoxel : first),
          base(24) + (axis == 0   ? first
                      : axis == 1 ? kUnitsPerVoxel
                                  : second),
          base(44) + (axis == 2 ? kUnitsPerVoxel : second)};
}

}  // namespace mw
