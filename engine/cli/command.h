// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The commands; each is one file.  Their help is in help.cpp.
#pragma once

#include "engine/cli/options/option_set.h"

namespace mw::cli {

struct Command {
  std::string name;
  std::string about;
  OptionSet options;
  /// What is left to do once the options have their values; returns the exit code.
  std::function<int(const OptionSet&)> run;
  std::string note;  ///< whole lines at the end of help
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

}  // namespace mw::cli
