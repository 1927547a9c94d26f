// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the processes of a run settle among themselves.
#pragma once

#include "engine/labels/boundary_faces.h"
#include "engine/run/processes.h"
#include "engine/settings/settings.h"
#include "engine/team/blocks/block_traffic.h"

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

}  // namespace mw::engine
