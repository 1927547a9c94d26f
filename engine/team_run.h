// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the processes of a run settle among themselves.
#pragma once

#include "engine/exchange/block_traffic.h"
#include "engine/labels/boundary_faces.h"
#include "engine/settings/settings.h"
#include "engine/window/window_visitor.h"

namespace mw::engine {

/// identity: lines "name = value" of what all must have in common.
/// ERRORS: mw::Error(kUsage) on every rank, naming what differs and where.
void agree(Team& team, const std::string& identity);

/// Who visits what, so that work is shared evenly: as rank 0 says, since sums of doubles could
/// differ between machines.
[[nodiscard]] Partition deal_windows(Team& team, const RunLayout& layout,
                                     const MeshSettings& settings, const BoundaryFaces& faces);

/// What all ranks did.  Every rank gets the sum.
[[nodiscard]] VisitStats sum_of_all(Team& team, const VisitStats& mine);
[[nodiscard]] TrafficFacts sum_of_all(Team& team, const TrafficFacts& mine);

/// Tells the others why this one ends, unless it ends because of them.
void tell(Team& team, const std::exception_ptr& error);

/// Until every rank has come here.
void wait_for_all(Team& team);

}  // namespace mw::engine
