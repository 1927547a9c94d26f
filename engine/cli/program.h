// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The whole command line: subcommands, messages, exit codes.
#pragma once

namespace mw::cli {

/// Runs the subcommand that the arguments name.  Returns the exit code; never throws.
int run_program(int argc, char** argv) noexcept;

}  // namespace mw::cli
