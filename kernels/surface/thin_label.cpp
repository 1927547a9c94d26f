// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tries all cubes, and counts voxels.
#include "kernels/surface/thin_label.h"

#include <algorithm>
#include <array>
#include <bit>

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

/// True if no cube of 2^3 voxels that is within `reach` of the corner has that label alone.
bool is_without_cubes(const LabelBox& labels, Index3 corner, std::int64_t reach, Label label) {
  for (std::int64_t z = -reach; z < reach - 1; ++z) {
    for (std::int64_t y = -reach; y < reach - 1; ++y) {
      for (std::int64_t x = -reach; x < reach - 1; ++x) {
        if (is_cube_of(labels, corner + Index3{x, y, z}, label)) return false;
      }
    }
  }
  return true;
}

/// How many voxels away from a corner the cube around it reaches.
constexpr std::int64_t kAround = 4;

/// The voxels of a label in the cube around a corner.
struct Surroundings {
  int voxels = 0;
  std::array<unsigned, 3> layers{};  ///< a bit for each layer across an axis that has some

  /// True if there are some in every layer across some axis.
  [[nodiscard]] bool go_through() const {
    constexpr unsigned kAll = (1U << 2 * kAround) - 1;
    return std::any_of(layers.begin(), layers.end(), [](unsigned some) { return some == kAll; });
  }
  /// True if none are in the outermost layer.
  [[nodiscard]] bool are_inside() const {
    constexpr unsigned kOutermost = 1U | 1U << (2 * kAround - 1);
    return std::none_of(layers.begin(), layers.end(),
                        [](unsigned some) { return (some & kOutermost) != 0; });
  }
  /// True if all are in one layer across some axis.
  [[nodiscard]] bool are_flat() const {
    return std::any_of(layers.begin(), layers.end(),
                       [](unsigned some) { return std::has_single_bit(some); });
  }
};

/// Looks at rows of voxels, as this is done at every thin vertex.
Surroundings look_around(const LabelBox& labels, Index3 corner, Label label) {
  Surroundings out;
  const Box3 cube = voxels_around(corner, kAround), box = intersection(cube, labels.box);
  if (box.lo.x >= box.hi.x) return out;
  for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
    for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
      const Label* row =
          &labels.labels[static_cast<std::size_t>(labels.box.offset({box.lo.x, y, z}))];
      unsigned found = 0;
      for (std::int64_t x = box.lo.x; x < box.hi.x; ++x) {
        found |= (without_side(*row++) == label ? 1U : 0U) << (x - cube.lo.x);
      }
      if (found == 0) continue;
      out.voxels += std::popcount(found);
      out.layers[0] |= found;
      out.layers[1] |= 1U << (y - cube.lo.y);
      out.layers[2] |= 1U << (z - cube.lo.z);
    }
  }
  return out;
}

}  // namespace

std::optional<ThinLabel> thin_label_at(const LabelBox& labels, Point place, Label label) {
  constexpr std::int64_t kReachOfThin = 2, kReachOfSheet = 5;
  constexpr int kLeastOfSheet = 56, kMostOfThread = 20;
  const Index3 corner = nearest_corner(place);
  if (!is_without_cubes(labels, corner, kReachOfThin, label)) return std::nullopt;
  const Surroundings around = look_around(labels, corner, label);
  return ThinLabel{
      .is_sheet = around.voxels >= kLeastOfSheet && !around.are_flat() &&
                  is_without_cubes(labels, corner, kReachOfSheet, label),
      .is_thread = around.voxels <= kMostOfThread && around.go_through(),
      .is_speck = around.are_inside(),
  };
}

}  // namespace mw
