// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The program mwmesh.
#include "engine/cli/exit_code.h"
#include "engine/cli/program.h"

namespace {

/// Runs before the constructors of static objects, which allocate as well (101 is the first
/// priority that is not the compiler's own).
[[gnu::constructor(101)]] void begin() {
  mw::cli::end_well_without_memory();
}

}  // namespace

int main(int argc, char** argv) {
  return mw::cli::run_program(argc, argv);
}
