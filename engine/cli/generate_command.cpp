// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh generate: manual pages and completion scripts, for the build; help does not list it.
#include <CLI/CLI.hpp>
#include <iostream>

#include "engine/cli/commands.h"
#include "engine/cli/completions.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/manual_page.h"
#include "engine/version.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

using Commands = std::vector<CommandFacts>;

ProgramFacts alone(Commands commands) {
  return {.name = "mwmesh",
          .does = "labelled voxel volumes to verified tetrahedral meshes",
          .called = "mwmesh",
          .about = "From a labelled voxel volume to a verified tetrahedral mesh.",
          .commands = std::move(commands),
          .examples = {"mwmesh mesh brain.nii.gz -o brain.vtu --report brain.json",
                       "mwmesh verify brain.nii.gz brain.vtu", "mwmesh info brain.vtu"}};
}

ProgramFacts shared(Commands commands) {
  std::erase_if(commands, [](const CommandFacts& command) { return command.name != "mesh"; });
  return {.name = "mwmesh-mpi",
          .does = "mwmesh mesh, shared by processes on one or more machines",
          .called = "mpirun -n N mwmesh-mpi",
          .about =
              "Takes the options of mwmesh mesh and writes the same mesh, byte for byte, for any "
              "number of processes. --memory and --threads are those of a machine, and shared "
              "by the processes on it; one process a machine is best, and --order colour keeps "
              "many busy. Volume, output and work folder are seen by all machines.",
          .commands = std::move(commands),
          .examples = {"mpirun -n 4 --map-by ppr:1:node:PE=64 mwmesh-mpi mesh em.zarr -o em.vtkhdf "
                       "--order colour"}};
}

ProgramFacts worker() {
  return {.name = "mwmesh-codt",
          .does = "constrained Delaunay triangulations for mwmesh",
          .called = "mwmesh-codt",
          .about =
              "A worker that mwmesh mesh --optimizer tetgen, and programs that use the library, "
              "start and talk to. It takes no options and does nothing by itself. The variable "
              "MW_CODT_WORKER names one in another place.",
          .commands = {},
          .examples = {}};
}

ProgramFacts facts_of(const std::string& program, const CLI::App& app) {
  if (program == "mwmesh") return alone(list_commands(app));
  if (program == "mwmesh-mpi") return shared(list_commands(app));
  if (program == "mwmesh-codt") return worker();
  throw Error(ErrorKind::kUsage, program + ": expected mwmesh, mwmesh-mpi or mwmesh-codt");
}

std::string generated(const std::string& what, const ProgramFacts& program) {
  if (what == "man") return manual_page(program, engine::version());
  if (what == "bash") return bash_completion(program);
  if (what == "zsh") return zsh_completion(program);
  if (what == "fish") return fish_completion(program);
  throw Error(ErrorKind::kUsage, what + ": expected man, bash, zsh or fish");
}

}  // namespace

void add_generate_command(CLI::App& app, Action& chosen) {
  CLI::App* command = app.add_subcommand(
      "generate", "prints the manual page of a program, or what a shell completes for it");
  command->group("");
  const auto what = std::make_shared<std::string>();
  const auto program = std::make_shared<std::string>("mwmesh");
  command->add_option("WHAT", *what, "which")->type_name("man|bash|zsh|fish")->required();
  command->add_option("PROGRAM", *program, "of which program")
      ->type_name("mwmesh|mwmesh-mpi|mwmesh-codt");
  command->callback([what, program, &app, &chosen] {
    chosen = [what, program, &app] {
      std::cout << generated(*what, facts_of(*program, app));
      return kExitDone;
    };
  });
}

}  // namespace mw::cli
