// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How voxels of thick slices are cut into layers, so that the lattice is nearly isotropic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/core/index.h"

namespace mw {

/// Most layers of a voxel: more than any axis of a lattice may have, and few enough that their
/// number along an axis does not overflow.
inline constexpr std::int64_t kMaxLayers = std::int64_t{1} << 20;

/// Returns how many layers a voxel is cut into along each axis: its spacing over the smallest one,
/// rounded (halves up).  The layers' spacing is between 2/3 and 3/2 of the smallest one, and layers
/// fill the same solid as voxels, so topology and volumes do not change.
/// REQUIRES: spacing finite and positive.  ENSURES: from 1 to kMaxLayers; 1 along the finest axis.
[[nodiscard]] inline Index3 layers_of(const std::array<double, 3>& spacing) {
  const double smallest = *std::min_element(spacing.begin(), spacing.end());
  const auto along = [&](double s) {
    const double layers = std::floor(s / smallest + 0.5);
    return static_cast<std::int64_t>(std::min(layers, static_cast<double>(kMaxLayers)));
  };
  return {along(spacing[0]), along(spacing[1]), along(spacing[2])};
}

/// Voxels of the lattice along each axis.
[[nodiscard]] inline Index3 layered_shape(Index3 shape, Index3 layers) {
  return {shape.x * layers.x, shape.y * layers.y, shape.z * layers.z};
}

/// Spacing of the lattice.
[[nodiscard]] inline std::array<double, 3> layered_spacing(const std::array<double, 3>& spacing,
                                                           Index3 layers) {
  return {spacing[0] / static_cast<double>(layers.x), spacing[1] / static_cast<double>(layers.y),
          spacing[2] / static_cast<double>(layers.z)};
}

}  // namespace mw
