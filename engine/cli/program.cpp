// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The whole command line: subcommands, messages, exit codes.
#include "engine/cli/program.h"
#include "engine/version.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

#include "engine/cli/commands.h"
#include "engine/cli/environment.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/run_processes.h"
#include "engine/cli/unknown_word.h"

namespace mw::cli {
namespace {

constexpr const char* kAbout =
    "From a labelled voxel volume to a verified tetrahedral mesh.\n"
    "Exit codes: 0 done, 1 internal error, 2 usage or config, 3 bad input, 4 out of a resource,\n"
    "5 a check failed, 75 interrupted and --resume can go on, 130 interrupted.";

void add_commands(CLI::App& app, Action& chosen) {
  app.option_defaults()->configurable(false);  // OptionSet says otherwise of its own
  add_mesh_command(app, chosen);
  add_verify_command(app, chosen);
  add_digest_command(app, chosen);
  add_info_command(app, chosen);
  add_stats_command(app, chosen);
  add_convert_command(app, chosen);
  add_surface_command(app, chosen);
  add_synth_command(app, chosen);
  add_picture_command(app, chosen);
  add_generate_command(app, chosen);
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", std::string("mwmesh ") + engine::version());
  for (CLI::App* command : app.get_subcommands({})) {
    command->set_version_flag("--version", std::string("mwmesh ") + engine::version());
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App app(kAbout, "mwmesh");
  Action chosen;
  add_commands(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return run_processes().speaks() ? app.exit(success) : kExitDone;  // --help and --version
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, explain(app, error));
  }
  if (!chosen) throw Error(ErrorKind::kUsage, "a subcommand is needed; see mwmesh --help");
  if (runs_are_divided() && !app.got_subcommand("mesh")) {
    throw Error(ErrorKind::kUsage,
                "mwmesh-mpi shares out mesh; for everything else there is mwmesh");
  }
  if (!app.got_subcommand("generate")) refuse_unknown_variables(app);
  const int code = chosen();
  if (!std::cout.flush()) throw Error(ErrorKind::kResource, "cannot write to standard output");
  return code;
}

}  // namespace

int run_program(int argc, char** argv) noexcept {
  // A file size limit is then a failed write with a message instead of a silent death.
  (void)std::signal(SIGXFSZ, SIG_IGN);
  return guarded([&] { return parse_and_run(argc, argv); });
}

int run_divided_program(int argc, char** argv, engine::Processes& processes) noexcept {
  (void)std::signal(SIGXFSZ, SIG_IGN);
  return guarded(
      [&] {
        divide_runs_among(processes);
        try {
          return parse_and_run(argc, argv);
        } catch (...) {
          processes.fail(std::current_exception());
          throw;
        }
      },
      !processes.speaks());
}

}  // namespace mw::cli
