// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/mesh/run_processes.h"

#include <unistd.h>

#include <algorithm>

#include "engine/cli/log.h"
#include "engine/system/crew.h"
#include "io/file/errors.h"

namespace mw::cli {
namespace {

engine::Processes* processes_of_program = nullptr;

/// Returns the cores of the machine; those that this process may use can be fewer.
int cores_of_machine() {
  return static_cast<int>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
}

int threads_of_process(int asked, int processes_here) {
  if (asked > 0) return std::max(1, asked / processes_here);
  const int own = engine::thread_count(0), machine = cores_of_machine();
  const int share = std::max(1, machine / processes_here);
  if (own == machine) return share;
  if (own < share) {
    log_warning(io::text(
        "this process may use ", own, " of ", machine, " cores, and its share of them is ", share,
        ": let mpirun bind less tightly (--bind-to none, or --map-by ppr:", processes_here,
        ":node:PE=", share, ")"));
  }
  return own;
}

}  // namespace

engine::Processes& run_processes() {
  return processes_of_program == nullptr ? engine::one_process() : *processes_of_program;
}

bool runs_are_divided() {
  return processes_of_program != nullptr;
}

void divide_runs_among(engine::Processes& processes) {
  processes_of_program = &processes;
}

void take_part(MeshRequest& request) {
  engine::RunHooks& run = request.job.run;
  run.processes = &run_processes();
  if (!runs_are_divided()) return;
  const int here = run_processes().count_here();
  run.store.memory /= static_cast<std::uint64_t>(here);
  run.threads = threads_of_process(run.threads, here);
  if (run_processes().speaks()) return;
  request.job.certify = engine::Certify::kOff;
  request.progress = "none";
  request.report.clear();
  request.html.clear();
  request.trace.clear();
}

}  // namespace mw::cli
