// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the labels of a volume on many threads.
#pragma once

#include "engine/labels/reading_tiles.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// Does what collect_labels() does for one part of a volume; the labels are in no particular order.
/// Together the parts have every voxel once.  If voxels may be no labels, parts are in file order.
[[nodiscard]] std::vector<RawLabel> labels_of_part(const io::LabelVolume& volume, int threads,
                                                   const SequencePart& part);

/// Does what io::collect_labels() does, on `threads` threads (0: all cores), whose number does not
/// change the result.  Volumes whose voxels may be no labels (floats, scaled numbers) are read in
/// file order, so that the error names the first such voxel.
/// Memory: a tile and 80 KiB a thread.
[[nodiscard]] io::LabelTable collect_labels(const io::LabelVolume& volume, int threads);

}  // namespace mw::engine
