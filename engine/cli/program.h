// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The whole command line: commands, messages, exit codes.
#pragma once

namespace mw::engine {
class Processes;
}

namespace mw::cli {

/// Runs the command that the arguments name.  Returns the exit code; never throws.
int run_program(int argc, char** argv) noexcept;

/// Runs the command divided among processes that have the same arguments.  One of them speaks, also
/// for another one that fails.  ENSURES: the others know of a failure before it returns.
int run_divided_program(int argc, char** argv, engine::Processes& processes) noexcept;

}  // namespace mw::cli
