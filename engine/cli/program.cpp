// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The whole command line: commands, messages, exit codes.
#include "engine/cli/program.h"
#include "engine/cli/options/config_file.h"
#include "engine/version.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iostream>

#include "engine/cli/command.h"
#include "engine/cli/exit_code.h"
#include "engine/cli/log.h"
#include "engine/cli/mesh/run_processes.h"
#include "io/file/errors.h"

namespace mw::cli {
namespace {

std::vector<Command> all_commands() {
  std::vector<Command> out;
  for (const auto make :
       {mesh_command, verify_command, info_command, surface_command, picture_command, serve_command,
        convert_command, digest_command, synth_command}) {
    out.push_back(make());
  }
  return out;
}

std::string answer(const CommandLine& line, const std::vector<Command>& commands) {
  if (line.asked == Asked::kVersion) return std::string("mwmesh ") + engine::version() + "\n";
  if (line.command == nullptr) return help_of_program(commands);
  return help_of_command(*line.command, line.asked == Asked::kHelpAll);
}

/// Windows, and what else has a frame, need some 100 KiB of stack.  A limit below kLeast is raised
/// where that is allowed: the main thread's stack grows up to what the limit is at the time.
void require_stack() {
  constexpr rlim_t kWanted = 1U << 20U, kLeast = 1U << 18U;
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kWanted) return;
  const rlim_t had = limit.rlim_cur;
  limit.rlim_cur = std::min(kWanted, limit.rlim_max);
  if (::setrlimit(RLIMIT_STACK, &limit) != 0) limit.rlim_cur = had;
  if (limit.rlim_cur >= kLeast) return;
  throw Error(ErrorKind::kResource, "a stack of " + std::to_string(limit.rlim_cur >> 10U) +
                                        " KiB is too small; raise the limit with ulimit -s 8192");
}

int run_command(const CommandLine& line, const std::vector<Command>& commands) {
  require_stack();
  if (line.command == nullptr) {
    io::fail_usage("a command is needed; see mwmesh --help");
  }
  if (runs_are_divided() && line.command->name != "mesh") {
    io::fail_usage("mwmesh-mpi shares out mesh; for everything else there is mwmesh");
  }
  std::vector<const OptionSet*> all;
  for (const Command& command : commands) all.push_back(&command.options);
  refuse_unknown_variables(all);
  OptionSet options = line.command->options;
  const auto config = line.flags.find("config");
  options.resolve(line.flags, config == line.flags.end() ? ConfigTexts()
                                                         : read_config(config->second, options));
  if (line.flags.contains("print-config")) {
    if (run_processes().speaks()) std::cout << options.toml();
    return kExitDone;
  }
  options.require_all();
  options.resolve_names(line.command->names);
  return line.command->run(options);
}

int parse_and_run(int argc, char** argv) {
  start_log(run_processes().speaks() ? "warn" : "off");
  const std::vector<Command> commands = all_commands();
  const CommandLine line = parse_command_line(commands, {argv + 1, argv + argc});
  int code = kExitDone;
  if (line.asked == Asked::kRun) {
    code = run_command(line, commands);
  } else if (run_processes().speaks()) {
    std::cout << answer(line, commands);
  }
  if (!std::cout.flush()) throw Error(ErrorKind::kResource, "cannot write to standard output");
  return code;
}

/// Gives the numbers of closed standard streams to files that neither take nor give bytes.  Else
/// the first files that are opened would get them, and messages would go into the mesh.
void hold_standard_streams() {
  for (int stream = 0; stream <= STDERR_FILENO; ++stream) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

bool is_mesh(int argc, char** argv) {
  return argc > 1 && std::string_view(argv[1]) == "mesh";
}

void begin() {
  hold_standard_streams();
  // Beyond a file size limit a write then fails, with a message, instead of killing the program.
  (void)std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace

int run_program(int argc, char** argv) noexcept {
  if (is_mesh(argc, argv)) end_if_interrupted();
  begin();
  return guarded([&] { return parse_and_run(argc, argv); });
}

int run_divided_program(int argc, char** argv, engine::Processes& processes) noexcept {
  begin();
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
