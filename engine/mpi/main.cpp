// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The program mwmesh-mpi: mwmesh mesh, shared by the processes that mpirun starts.
#include "engine/cli/exit_code.h"
#include "engine/cli/program.h"
#include "engine/mpi/mpi_exchange.h"
#include "engine/team/team_processes.h"

namespace {

/// Runs before the constructors of static objects, for the reason in engine/cli/main.cpp.
[[gnu::constructor(101)]] void begin() {
  mw::cli::end_well_without_memory();
}

int run(int argc, char** argv, mw::engine::Exchange& exchange) {
  mw::engine::Team team(exchange);
  mw::engine::TeamProcesses processes(team);
  return mw::cli::run_divided_program(argc, argv, processes);
}

}  // namespace

int main(int argc, char** argv) {
  mw::engine::MpiExchange exchange;
  exchange.leave(run(argc, argv, exchange));
}
