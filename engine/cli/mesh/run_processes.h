// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The processes that this program shares its run with, and what each one's part is.
#pragma once

#include "engine/cli/requests.h"
#include "engine/run/processes.h"

namespace mw::cli {

/// Returns the processes that `mwmesh mesh` is divided among; one by default.
[[nodiscard]] engine::Processes& run_processes();
/// True if the program is one of those that mpirun starts, even if it is the only one.
[[nodiscard]] bool runs_are_divided();
/// To be called once by a program, before any command runs.
void divide_runs_among(engine::Processes& processes);

/// Makes a request this process's part of it: the machine's threads and memory are divided by the
/// processes on it, and only the process that speaks shows progress, certifies and reports.
void take_part(MeshRequest& request);

}  // namespace mw::cli
