// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a run's page that come from its report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mw::cli {

// Each takes the report of a run (run_report) and gives HTML.

/// Title, what went in, and the figures that matter first.
[[nodiscard]] std::string head_section(const nlohmann::ordered_json& report);
/// P1 to P8: what the run itself has seen to hold, or not; of the others how to check them.
[[nodiscard]] std::string promise_section(const nlohmann::ordered_json& report);
/// Where time and memory went.
[[nodiscard]] std::string engine_section(const nlohmann::ordered_json& report);
/// All settings, and the digest.
[[nodiscard]] std::string settings_section(const nlohmann::ordered_json& report);

/// The command that checks the mesh, with the options of the run that the check needs.
[[nodiscard]] std::string verify_command(const nlohmann::ordered_json& report);

}  // namespace mw::cli
