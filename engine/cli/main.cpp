// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The program mwmesh.
#include "engine/cli/program.h"

int main(int argc, char** argv) {
  return mw::cli::run_program(argc, argv);
}
