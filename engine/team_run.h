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

/// What one rank did and held.
struct RankFacts {
  std::uint64_t windows = 0;
  TrafficFacts sent;
  std::uint64_t peak_accounted_bytes = 0;
  std::array<std::uint64_t, kPurposes> peak_bytes_by_purpose{};  ///< not at the same time
};

/// Those of all, by rank; returns when every rank has come here.
[[nodiscard]] std::vector<RankFacts> facts_of_all(Team& team, const RankFacts& mine);

}  // namespace mw::engine
