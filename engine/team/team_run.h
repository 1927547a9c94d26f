// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the processes of a run settle among themselves, and the labels that each of them reads: its
// part of what all must know, and what its own windows need.
#pragma once

#include "engine/labels/label_counts.h"
#include "engine/labels/label_need.h"
#include "engine/run/processes.h"
#include "engine/settings/settings.h"
#include "engine/team/blocks/block_traffic.h"
#include "engine/team/blocks/partition.h"
#include "engine/team/team.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// Checks that all ranks have the same identity: lines "name = value".
/// ERRORS: mw::Error(kUsage) on every rank, naming what differs and where.
void agree(Team& team, const std::string& identity);

/// Returns when all ranks have called it.
void wait_for_all(Team& team);

/// Returns which rank visits which window, so that work is shared evenly.  Rank 0 decides, since
/// sums of doubles could differ between machines.
[[nodiscard]] Partition deal_windows(Team& team, const RunLayout& layout,
                                     const MeshSettings& settings, const BoundaryFaces& faces);

/// Returns the sum of what all ranks did, on every rank.
[[nodiscard]] VisitStats sum_of_all(Team& team, const VisitStats& mine);

/// Returns what every rank did, by rank, once every rank has called it.
[[nodiscard]] std::vector<ProcessFacts> facts_of_all(Team& team, const ProcessFacts& mine);

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
