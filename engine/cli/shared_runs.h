// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whether this program is one of several that share a run, and what each one's part is.
#pragma once

#include <string>

#include "engine/cli/mesh_request.h"
#include "engine/exchange/team.h"

namespace mw::cli {

/// The processes that share a run with this one; null: there are none.
[[nodiscard]] engine::Team* shared_team();
/// Once a program, before any command runs.
void share_runs_with(engine::Team* team);

/// Makes a request one rank's part of it: threads and memory are those of the machine, and divided
/// by the ranks that share it; work goes into a folder a rank; only rank 0 shows, checks and
/// writes. ERRORS: mw::Error(kUsage) for what a shared run cannot do.
void take_part(MeshRequest& request, const engine::Team& team);

}  // namespace mw::cli
