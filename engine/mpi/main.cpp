// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The program mwmesh-mpi: mwmesh mesh, shared by the processes that mpirun starts.
#include "engine/cli/out_of_memory.h"
#include "engine/cli/program.h"
#include "engine/mpi/mpi_exchange.h"

namespace {

/// As in engine/cli/main.cpp.
[[gnu::constructor(101)]] void begin() {
  mw::cli::end_well_without_memory();
}

}  // namespace

int main(int argc, char** argv) {
  mw::engine::MpiExchange exchange;
  exchange.leave(mw::cli::run_shared_program(argc, argv, exchange));
}
