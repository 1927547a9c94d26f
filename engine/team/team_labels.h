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

/// collect_labels() by all ranks, each its part; the volume then has the fingerprint of all of it.
/// No rank sees all labels, so two of them look at a piece of each part: the volumes of a run must
/// be one.  It guards against mistakes.
/// ERRORS: kUsage when they differ there; what the volume throws; of several ranks every one tells
/// that of the first, so that of
///         voxels that are no labels it is the first in the file.
[[nodiscard]] io::LabelTable collect_together(Team& team, FingerprintVolume& volume, int threads);

/// The counts of the whole volume, of which every rank reads its part.
/// ERRORS: those of the volume; of another rank.
[[nodiscard]] LabelCounts count_together(Team& team, const io::DenseVolume& volume, int threads);

/// What the windows of a rank need: start meshes for blocks of the first march, and, where
/// distances are bounded, labels around the windows of all marches.
[[nodiscard]] LabelNeed labels_needed(const RunLayout& layout, const Partition& partition, int rank,
                                      const MeshSettings& settings);

}  // namespace mw::engine
