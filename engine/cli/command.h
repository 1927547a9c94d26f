// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The commands, their help (help.cpp), and what is on the command line: command_line.cpp alone
// knows the library that reads it.
#pragma once

#include "engine/cli/options/option_set.h"

namespace mw::cli {

struct Command {
  std::string name;
  std::string about;
  OptionSet options;
  /// What is left to do once the options have their values; returns the exit code.
  std::function<int(const OptionSet&)> run;
  std::string older_name;  ///< which is taken, too, and listed nowhere; empty: there is none
  std::string note;        ///< whole lines at the end of help
  /// What labels are called in what the command reads; asked for where an option has a name.
  std::function<io::LabelNames()> names;
};

/// The commands, a line each.
[[nodiscard]] std::string help_of_program(const std::vector<Command>& commands);
/// The options of a command by group, a line each; with all those for experts, too.
[[nodiscard]] std::string help_of_command(const Command& command, bool all);

[[nodiscard]] Command mesh_command();
[[nodiscard]] Command verify_command();
[[nodiscard]] Command info_command();
[[nodiscard]] Command convert_command();
[[nodiscard]] Command surface_command();
[[nodiscard]] Command picture_command();
[[nodiscard]] Command digest_command();
[[nodiscard]] Command synth_command();

enum class Asked { kRun, kHelp, kHelpAll, kVersion };

struct CommandLine {
  Asked asked = Asked::kRun;
  const Command* command = nullptr;          ///< empty: none was named
  std::map<std::string, std::string> flags;  ///< as OptionSet::resolve() takes them
};

/// `help COMMAND` is `COMMAND --help`.  REQUIRES: commands outlive the result.
/// ERRORS: mw::Error(kUsage) naming the unknown command or flag, which is often why something else
///         is missing; else what is wrong.
[[nodiscard]] CommandLine parse_command_line(const std::vector<Command>& commands,
                                             std::vector<std::string> arguments);

}  // namespace mw::cli
