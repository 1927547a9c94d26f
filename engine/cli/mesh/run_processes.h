// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The processes that this program shares its run with, and what each one's part is.
#pragma once

#include <memory>
#include <string>

#include "engine/cli/requests.h"
#include "engine/run/processes.h"
#include "io/mesh/shared_mesh.h"

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

/// What one process of a run writes the mesh into, together with the others.
struct SharedOutput {
  /// Null on the process that speaks when it writes alone.  The others have it in any case, since
  /// they learn only later whether the first shares it.
  std::unique_ptr<io::SharedMesh> mesh;
  /// Says on the process that speaks why it writes alone; empty where it does not.
  std::string why_alone;
};

/// Returns nothing where runs_are_divided() is false.  is_certified tells that the process that
/// speaks makes a certificate, for which, as for a page, the whole mesh has to pass through it.
/// ERRORS: those of making the file, which the process that speaks does.
[[nodiscard]] SharedOutput open_shared_output(const MeshRequest& request, bool is_certified);

}  // namespace mw::cli
