// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a run's page that come from its report.
#pragma once

#include <string>

#include "io/json/json.h"

namespace mw::cli {

// Each takes the report of a run (run_report) and gives HTML.

/// Returns the title, the inputs, and the figures that matter first.
[[nodiscard]] std::string head_section(const io::Json& report);
/// Returns which of P1 to P8 the run itself has seen to hold or not, and how to check the others.
[[nodiscard]] std::string promise_section(const io::Json& report);
/// Returns where time and memory went.
[[nodiscard]] std::string engine_section(const io::Json& report);
/// Returns all settings and the digest.
[[nodiscard]] std::string settings_section(const io::Json& report);

/// Returns the command that checks the mesh, with the options of the run that the check needs.
[[nodiscard]] std::string verify_command(const io::Json& report);

}  // namespace mw::cli
