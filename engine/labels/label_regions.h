// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where each label of a volume is, and how much of it there is.
#pragma once

#include <vector>

#include "io/volume/label_volume.h"

namespace mw::engine {

struct LabelRegion {
  RawLabel label = 0;
  std::uint64_t voxels = 0;
  Box3 box;  ///< the smallest that has them all
};

/// One pass over the volume.  Ascending by label, as signed numbers where the volume's are.
/// Memory: a tile (ReadingTiles), and some 150 bytes a label.
/// ERRORS: what the volume throws.
[[nodiscard]] std::vector<LabelRegion> label_regions(const io::LabelVolume& volume);

}  // namespace mw::engine
