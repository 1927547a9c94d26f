// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of several cubes of 16 voxels with room for the largest cells.
#pragma once

#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {

/// One label, and a corner or a slab of another kind of volume; odd shapes.
[[nodiscard]] inline SmallVolume random_with_large_cells(std::mt19937& random) {
  const auto edge = [&](std::uint32_t min) { return std::int64_t{min + below(random, 24)}; };
  const auto x = edge(38), y = edge(32), z = edge(26);
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  SmallVolume volume = random_volume_of(random, kind, {x, y, z}, 1 + below(random, 3));
  const Index3 from{below(random, 6), below(random, 6), below(random, 4)};
  const bool slab = below(random, 2) == 0, upper = below(random, 2) == 0;
  std::size_t i = 0;
  for_each_index(volume.shape, [&](Index3 v) {
    if (upper) v = volume.shape - Index3{1, 1, 1} - v;
    if (v.x >= from.x && (slab || (v.y >= from.y && v.z >= from.z))) volume.labels[i] = 0;
    ++i;
  });
  return volume;
}

}  // namespace mw::test
