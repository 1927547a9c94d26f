// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sample points on the voxel faces between two labels: what the distance bound carries along.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw {

/// Each voxel face has a sample at the centre of each of its quarters.
inline constexpr unsigned kSamplesPerFace = 4;
/// Largest distance of a point of a voxel face to the nearest of its four samples: sqrt(2) / 4.
/// It is also how far the samples are from the centre of the face.
inline constexpr double kSampleCoveringRadius = 0.35355339059327379;
/// The most voxels along an axis that samples can number.
inline constexpr std::int64_t kMaxSampledVoxels = 1 << 19;

/// Some of the four samples of a voxel face, packed into 8 bytes.  From bit 62 down these hold z, y
/// and x (19 bits each) of the voxel on the face's lower side, the face's axis (2 bits), and one
/// bit for each quarter.
using FaceSamples = std::uint64_t;

/// One bit for each quarter, 0 to 3.
using QuarterBits = unsigned;
inline constexpr QuarterBits kAllQuarters = 15;

[[nodiscard]] inline FaceSamples face_samples(Index3 lower_voxel, unsigned axis,
                                              QuarterBits quarters) {
  return static_cast<FaceSamples>(lower_voxel.z) << 44 |
         static_cast<FaceSamples>(lower_voxel.y) << 25 |
         static_cast<FaceSamples>(lower_voxel.x) << 6 | axis << 4 | quarters;
}

[[nodiscard]] inline QuarterBits quarters_of(FaceSamples samples) {
  return static_cast<QuarterBits>(samples & kAllQuarters);
}

[[nodiscard]] inline unsigned axis_of(FaceSamples samples) {
  return static_cast<unsigned>(samples >> 4 & 3U);
}

/// The voxel on the face's lower side.
[[nodiscard]] inline Index3 lower_voxel(FaceSamples samples) {
  constexpr FaceSamples kCoordinate = kMaxSampledVoxels - 1;
  const auto along = [samples](unsigned shift) {
    return static_cast<std::int64_t>(samples >> shift & kCoordinate);
  };
  return {along(6), along(25), along(44)};
}

[[nodiscard]] inline bool on_same_face(FaceSamples a, FaceSamples b) {
  return ((a ^ b) & ~FaceSamples{kAllQuarters}) == 0;
}

/// This face with other quarters.
[[nodiscard]] inline FaceSamples with_quarters(FaceSamples samples, QuarterBits quarters) {
  return (samples & ~FaceSamples{kAllQuarters}) | quarters;
}

/// Returns the point of the face that is `first` units from its lowest corner along the lower of
/// its two axes, and `second` along the higher.
[[nodiscard]] inline Point point_on_face(FaceSamples samples, std::int32_t first,
                                         std::int32_t second) {
  constexpr FaceSamples kCoordinate = kMaxSampledVoxels - 1;
  const unsigned axis = axis_of(samples);
  const auto base = [samples](unsigned shift) {
    return static_cast<std::int32_t>(samples >> shift & kCoordinate) * kUnitsPerVoxel;
  };
  return {base(6) + (axis == 0 ? kUnitsPerVoxel : first),
          base(25) + (axis == 0   ? first
                      : axis == 1 ? kUnitsPerVoxel
                                  : second),
          base(44) + (axis == 2 ? kUnitsPerVoxel : second)};
}

[[nodiscard]] inline Point face_centre(FaceSamples samples) {
  return point_on_face(samples, kUnitsPerVoxel / 2, kUnitsPerVoxel / 2);
}

/// Returns where the sample of a quarter lies.  Bit 0 of the quarter's number is set in the upper
/// half along the face's first axis, bit 1 along its second (axes in ascending order).
[[nodiscard]] inline Point sample_position(FaceSamples samples, unsigned quarter) {
  constexpr std::int32_t kQuarter = kUnitsPerVoxel / 4, kHalf = kUnitsPerVoxel / 2;
  return point_on_face(samples, kQuarter + static_cast<std::int32_t>(quarter & 1U) * kHalf,
                       kQuarter + static_cast<std::int32_t>(quarter >> 1 & 1U) * kHalf);
}

}  // namespace mw
