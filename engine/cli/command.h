// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The commands, their help (help.cpp), and what is on the command line: command_line.cpp alone
// knows the library that reads it.
#pragma once

#include "engine/cli/requests.h"

namespace mw::cli {

struct Command {
  std::string name;
  std::string about;
  OptionSet options;
  /// Runs the command once the options have their values; returns the exit code.
  std::function<int(const OptionSet&)> run;
  /// An older name, which is taken as well and listed nowhere; empty where there is none.
  std::string older_name;
  std::string note;  ///< whole lines at the end of help
  /// Returns the names of labels in what the command reads; called when an option names a label.
  std::function<io::LabelNames()> names;
};

/// Returns the help of the program, with one line for each command.
[[nodiscard]] std::string help_of_program(const std::vector<Command>& commands);
/// Returns a line for each option of a command, by group, with those for experts if `all` is true.
[[nodiscard]] std::string help_of_command(const Command& command, bool all);

[[nodiscard]] Command mesh_command();
[[nodiscard]] Command verify_command();
[[nodiscard]] Command info_command();
[[nodiscard]] Command convert_command();
[[nodiscard]] Command surface_command();
[[nodiscard]] Command picture_command();
[[nodiscard]] Command serve_command();
[[nodiscard]] Command digest_command();
[[nodiscard]] Command synth_command();

enum class Asked { kRun, kHelp, kHelpAll, kVersion };

struct CommandLine {
  Asked asked = Asked::kRun;
  const Command* command = nullptr;          ///< null if none was named
  std::map<std::string, std::string> flags;  ///< as OptionSet::resolve() takes them
};

/// Takes `help COMMAND` for `COMMAND --help`.  REQUIRES: commands outlive the result.
/// ERRORS: mw::Error(kUsage) naming an unknown command or flag, which is often why something else
///         is missing; if there is none, naming what is wrong.
[[nodiscard]] CommandLine parse_command_line(const std::vector<Command>& commands,
                                             std::vector<std::string> arguments);

}  // namespace mw::cli
