// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The subcommands; each is one file.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace mw::cli {

/// What is left to do once the command line has been read; returns the exit code.
using Action = std::function<int()>;

/// Each adds its subcommand to the program, which sets `chosen` when it is named.
/// REQUIRES: chosen outlives the parsing.
void add_mesh_command(CLI::App& program, Action& chosen);
void add_verify_command(CLI::App& program, Action& chosen);
void add_digest_command(CLI::App& program, Action& chosen);
void add_info_command(CLI::App& program, Action& chosen);
void add_stats_command(CLI::App& program, Action& chosen);
void add_convert_command(CLI::App& program, Action& chosen);
void add_surface_command(CLI::App& program, Action& chosen);
void add_synth_command(CLI::App& program, Action& chosen);
void add_picture_command(CLI::App& program, Action& chosen);
void add_generate_command(CLI::App& program, Action& chosen);

}  // namespace mw::cli
