// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whole small volumes coarsened, for tests.
#pragma once

#include "kernels/start/coarsen/coarsen.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {

/// The coarsened labels of a tile.
[[nodiscard]] inline LabelBox coarsened(const SmallVolume& volume, const Box3& tile,
                                        double max_distance, CoarsenStats& stats) {
  const Index3 halo{kCoarsenHalo, kCoarsenHalo, kCoarsenHalo};
  const LabelBox before = labels_in(volume, {tile.lo - halo, tile.hi + halo});
  LabelBox after = before;
  stats += coarsen(before, after, tile, {.within = {{0, 0, 0}, volume.shape}}, max_distance);
  LabelBox out{tile, {}};
  for_each_index(tile, [&](Index3 v) { out.labels.push_back(after.at(v)); });
  return out;
}

/// All of it at once.
[[nodiscard]] inline SmallVolume coarsened(SmallVolume volume, double max_distance,
                                           CoarsenStats& stats) {
  volume.labels = coarsened(volume, {{0, 0, 0}, volume.shape}, max_distance, stats).labels;
  return volume;
}

[[nodiscard]] inline SmallVolume coarsened(SmallVolume volume, double max_distance) {
  CoarsenStats stats;
  return coarsened(std::move(volume), max_distance, stats);
}

}  // namespace mw::test
