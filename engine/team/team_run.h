// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the processes of a run settle among themselves.
#pragma once

#include "engine/labels/boundary_faces.h"
#include "engine/run/processes.h"
#include "engine/settings/settings.h"
#include "engine/team/blocks/block_traffic.h"

namespace mw::engine {

/// identity: lines "name = value" of what all must have in common.
/// ERRORS: mw::Error(kUsage) on every rank, naming what differs and where.
void agree(Team& team, const std::string& identity);

/// Returns when all ranks have called it.
void wait_for_all(Team& team);

/// Who visits what, so that work is shared evenly: as rank 0 says, since sums of doubles could
/// differ between machines.
[[nodiscard]] Partition deal_windows(Team& team, const RunLayout& layout,
                                     const MeshSettings& settings, const BoundaryFaces& faces);

/// What all ranks did.  Every rank gets the sum.
[[nodiscard]] VisitStats sum_of_all(Team& team, const VisitStats& mine);

/// What every rank did, by rank; returns when every rank has come here.
[[nodiscard]] std::vector<ProcessFacts> facts_of_all(Team& team, const ProcessFacts& mine);

}  // namespace mw::engine
