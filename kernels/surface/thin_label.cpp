// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tries all cubes.
#include "kernels/surface/thin_label.h"

#include "kernels/core/index.h"

namespace mw {
namespace {

Index3 nearest_corner(Point place) {
  const auto nearest = [](std::int32_t units) {
    return (std::int64_t{units} + kUnitsPerVoxel / 2) / kUnitsPerVoxel;
  };
  return {nearest(place.x), nearest(place.y), nearest(place.z)};
}

Box3 voxels_around(Index3 corner, std::int64_t reach) {
  const Index3 around{reach, reach, reach};
  return {corner - around, corner + around};
}

bool has_label(const LabelBox& labels, Index3 voxel, Label label) {
  return labels.box.contains(voxel) && without_side(labels.at(voxel)) == label;
}

bool is_cube_of(const LabelBox& labels, Index3 lowest, Label label) {
  for (std::int64_t corner = 7; corner >= 0; --corner) {
    const Index3 step{corner & 1, corner >> 1 & 1, corner >> 2};
    if (!has_label(labels, lowest + step, label)) return false;
  }
  return true;
}

}  // namespace

bool is_thin_at(const LabelBox& labels, Point place, Label label) {
  const Index3 at = nearest_corner(place);
  for (std::int64_t z = -2; z < 1; ++z) {
    for (std::int64_t y = -2; y < 1; ++y) {
      for (std::int64_t x = -2; x < 1; ++x) {
        if (is_cube_of(labels, at + Index3{x, y, z}, label)) return false;
      }
    }
  }
  return true;
}

bool is_speck_at(const LabelBox& labels, Point place, Label label) {
  constexpr std::int64_t kReach = 3;
  if (!is_thin_at(labels, place, label)) return false;
  const Box3 near = voxels_around(nearest_corner(place), kReach);
  bool goes_on = false;
  for_each_index(voxels_around(nearest_corner(place), kReach + 1), [&](Index3 voxel) {
    goes_on = goes_on || (!near.contains(voxel) && has_label(labels, voxel, label));
  });
  return !goes_on;
}

}  // namespace mw
