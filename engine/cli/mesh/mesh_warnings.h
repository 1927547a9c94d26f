// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run of `mwmesh mesh` warns of at its end.
#pragma once

#include "engine/report/run_report.h"

namespace mw::cli {

/// Warns of options that asked for what the mesh cannot have.
void print_warnings(const report::FinishedRun& run);

}  // namespace mw::cli
