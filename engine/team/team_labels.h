// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels in a run of several processes: each reads its part of what all must know, and the labels
// that its own windows need.
#pragma once

#include "engine/labels/fingerprint.h"
#include "engine/labels/label_counts.h"
#include "engine/labels/label_need.h"
#include "engine/team/blocks/partition.h"
#include "engine/team/team.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// Does what collect_labels() does by all ranks, each of which reads its part; the volume then has
/// the fingerprint of all of it.  All ranks must read the same volume.  To guard against mistakes,
/// two of them compare a piece of each part.
/// ERRORS: kUsage when the pieces differ; what the volume throws.  If several ranks fail, all throw
/// the error of the first of them, so of voxels that are no labels the first in the file is named.
[[nodiscard]] io::LabelTable collect_together(Team& team, FingerprintVolume& volume, int threads);

/// Returns the counts of the whole volume, of which every rank reads its part.
/// ERRORS: those of the volume, and those of another rank.
[[nodiscard]] LabelCounts count_together(Team& team, const io::DenseVolume& volume, int threads);

/// Returns the labels that the windows of a rank need: those for start meshes of blocks of the
/// first march, and, where distances are bounded, those around the windows of all marches.
[[nodiscard]] LabelNeed labels_needed(const RunLayout& layout, const Partition& partition, int rank,
                                      const MeshSettings& settings);

}  // namespace mw::engine
