// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a volume has, found by many threads.
#pragma once

#include "io/labels/label_table.h"

namespace mw::engine {

/// As io::collect_labels, on so many threads (0: all cores), which change nothing; volumes whose
/// voxels may turn out to be no labels (floats, scaled numbers) are read in file order, so that the
/// first of them is the one that is told.
/// Memory: a tile and 80 KiB a thread.
[[nodiscard]] io::LabelTable collect_labels(const io::LabelVolume& volume, int threads);

}  // namespace mw::engine
