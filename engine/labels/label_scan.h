// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the labels of a volume on many threads, whose number suits the volume.
#pragma once

#include "engine/labels/reading_tiles.h"
#include "io/labels/label_table.h"
#include "io/volume/volume_readers.h"

namespace mw::engine {

using io::ReaderRoom;

/// Returns how many threads read a volume at once: `threads` (0: all cores) of them, and at least
/// io::kFarReaders where reading waits for a network, or fewer where there is no room for them
/// (io::readers_that_fit()).
[[nodiscard]] int reader_count(const io::LabelVolume& volume, int threads, const ReaderRoom& room);
/// Likewise for labels_of_part(), collect_labels() and label_regions().
[[nodiscard]] int scanner_count(const io::LabelVolume& volume, int threads, std::uint64_t memory);

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
