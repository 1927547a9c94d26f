// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a volume has, found by many threads.
#pragma once

#include "engine/labels/reading_tiles.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// The labels of one part of a volume, in no particular order; together the parts have all voxels,
/// each once, earlier parts those that come earlier in the file.  Otherwise as collect_labels().
[[nodiscard]] std::vector<RawLabel> labels_of_part(const io::LabelVolume& volume, int threads,
                                                   const SequencePart& part);

/// Does what io::collect_labels() does, on `threads` threads (0: all cores), whose number does not
/// change the result.  Volumes whose voxels may be no labels (floats, scaled numbers) are read in
/// file order, so that the error names the first such voxel.
/// Memory: a tile and 80 KiB a thread.
[[nodiscard]] io::LabelTable collect_labels(const io::LabelVolume& volume, int threads);

}  // namespace mw::engine
