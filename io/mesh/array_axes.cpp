// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From the world back to the array.
#include "io/mesh/array_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/core/lattice.h"

namespace mw::io {
namespace {

/// True if the corner's place in the world is p up to rounding.
bool is_position_of(const VolumeSpace& space, const Vector3& corner, const Position& p) {
  constexpr double kUnitsInLastPlace = 10;
  constexpr double kRounding = kUnitsInLastPlace * std::numeric_limits<double>::epsilon();
  const Vector3 position = to_world(space, corner);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    largest =
        std::max({largest, std::abs(space.origin[i]), space.spacing[i] * std::abs(corner[i])});
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(std::abs(position[k] - p[k]) <= kRounding * largest)) return false;
  }
  return true;
}

Vector3 nearest_lattice_point(const Vector3& corner, Index3 layers) {
  const auto nearest = [](double x, std::int64_t parts) {
    const auto units = static_cast<double>(parts * kUnitsPerVoxel);
    return std::nearbyint(x * units) / units;
  };
  return {nearest(corner[0], layers.x), nearest(corner[1], layers.y), nearest(corner[2], layers.z)};
}

}  // namespace

Position array_position(const VolumeSpace& space, const Position& p, Index3 layers) {
  const Vector3 corner = to_corner(space, p);
  const Vector3 point = nearest_lattice_point(corner, layers);
  const Vector3& found = is_position_of(space, point, p) ? point : corner;
  Position out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = space.spacing[i] * found[i];
  return out;
}

}  // namespace mw::io
