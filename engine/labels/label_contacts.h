// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels of a volume touch, and in how many faces of voxels.
#pragma once

#include <array>
#include <vector>

#include "io/volume/label_volume.h"

namespace mw::engine {

/// Two labels, first < second as unsigned numbers.
struct LabelContact {
  RawLabel first = 0;
  RawLabel second = 0;
  std::array<std::uint64_t, 3> faces{};  ///< across x, y and z of the array
};

/// One pass over the volume.  Ascending by first, then second.
/// Memory: a tile (ReadingTiles) and one voxel around it, and some 100 bytes a pair.
/// ERRORS: what the volume throws.
[[nodiscard]] std::vector<LabelContact> label_contacts(const io::LabelVolume& volume);

}  // namespace mw::engine
