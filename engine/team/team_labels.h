// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels in a run of several processes: each reads its part of what all must know, and the labels
// that its own windows need.
#pragma once

#include "engine/labels/label_counts.h"
#include "engine/labels/label_need.h"
#include "engine/team/partition.h"
#include "engine/team/team.h"

namespace mw::engine {

/// The counts of the whole volume, of which every rank reads its part.
/// ERRORS: those of the volume; of another rank.
[[nodiscard]] LabelCounts count_together(Team& team, const io::DenseVolume& volume, int threads);

/// What the windows of a rank need: start meshes for blocks of the first march, and, where
/// distances are bounded, labels around the windows of all marches.
[[nodiscard]] LabelNeed labels_needed(const RunLayout& layout, const Partition& partition, int rank,
                                      const MeshSettings& settings);

}  // namespace mw::engine
