// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The whole command line: subcommands, messages, exit codes.
#pragma once

#include "engine/exchange/exchange.h"

namespace mw::cli {

/// Runs the subcommand that the arguments name.  Returns the exit code; never throws.
int run_program(int argc, char** argv) noexcept;

/// The same, shared with other processes that are given the same arguments.  Rank 0 alone speaks:
/// for itself, and for a rank that fails.  ENSURES: the others know of a failure before it returns.
int run_shared_program(int argc, char** argv, engine::Exchange& exchange) noexcept;

}  // namespace mw::cli
