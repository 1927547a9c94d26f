// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where each label of a volume is, how much of it there is, and which labels touch.
#pragma once

#include <array>
#include <vector>

#include "io/volume/label_volume.h"

namespace mw::engine {

struct LabelRegion {
  RawLabel label = 0;
  std::uint64_t voxels = 0;
  Box3 box;  ///< the smallest box that holds all of them
};

/// Returns the labels, ascending (as signed numbers where the volume's are), in one pass over it.
/// `threads` threads read; their number does not change the result.
/// Memory: a tile (ReadingTiles) a thread, or 8 where reading waits for a network, and some 150
/// bytes a label and thread. ERRORS: what the volume throws.
[[nodiscard]] std::vector<LabelRegion> label_regions(const io::LabelVolume& volume,
                                                     int threads = 1);

/// Two labels, first < second as unsigned numbers.
struct LabelContact {
  RawLabel first = 0;
  RawLabel second = 0;
  std::array<std::uint64_t, 3> faces{};  ///< across x, y and z of the array
};

/// Returns the contacts, ascending by first, then second, in one pass over the volume.
/// `threads` threads read; their number does not change the result.
/// Memory: on each thread a tile (ReadingTiles) and one voxel around it, and some 100 bytes a pair.
/// ERRORS: what the volume throws.
[[nodiscard]] std::vector<LabelContact> label_contacts(const io::LabelVolume& volume,
                                                       int threads = 1);

}  // namespace mw::engine
