// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is on the command line; this alone knows the library that reads it.
#pragma once

#include "engine/cli/command.h"

namespace mw::cli {

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
