// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The scale of sizes for a number of tets: that of a run that this one goes on with, or a pilot's.
#pragma once

#include <string>

#include "engine/job/count_pilot.h"

namespace mw::engine {

/// Returns what a run shares with the one that it goes on from, beside what the engine adds.
[[nodiscard]] std::string identity_of(const report::FinishedRun& run);

/// Finds the scale by a pilot, unless an earlier run has done so.  ERRORS: mw::Error(kUsage) for a
/// work folder that the run could not use, before the pilot makes a mesh.
[[nodiscard]] report::CountFacts count_facts(const PilotTask& task, const report::FinishedRun& run);

}  // namespace mw::engine
