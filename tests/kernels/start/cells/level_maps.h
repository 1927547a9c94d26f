// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The map of large cells of a whole volume, for tests and benchmarks.
#pragma once

#include <algorithm>

#include "kernels/core/index.h"
#include "kernels/start/cells/cell_levels.h"

namespace mw::test {

/// labels_in(box): the LabelBox of a box that may reach outside the volume.
template <typename LabelsIn>
[[nodiscard]] LevelMap level_map(Index3 volume, LabelsIn labels_in) {
  LevelMap map(volume);
  const auto box_of = [](Index3 cube, std::int64_t halo) {
    constexpr std::int64_t kCube = LevelMap::kCube;
    const Index3 lo{cube.x * kCube, cube.y * kCube, cube.z * kCube}, around{halo, halo, halo};
    return Box3{lo - around, lo + Index3{kCube, kCube, kCube} + around};
  };
  for_each_index(map.cubes(), [&](Index3 cube) {
    const LabelBox labels = labels_in(box_of(cube, LevelMap::kHalo));
    map.set_eighths(cube, LevelMap::allowed_eighths(labels, volume, cube));
  });
  map.find_cubes([&](Index3 cube) {
    const std::vector<Label> labels = labels_in(box_of(cube, 0)).labels;
    return labels[0] != kExterior &&
           std::all_of(labels.begin(), labels.end(), [&](Label l) { return l == labels[0]; });
  });
  return map;
}

}  // namespace mw::test
