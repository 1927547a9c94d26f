// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The subcommands and their flags as plain lists, for the manual page and for shells.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace mw::cli {

struct FlagFacts {
  std::vector<std::string> names;  ///< "-o", "--output", short ones first; of a positional: "INPUT"
  std::string value;               ///< what help calls it; empty: a switch
  std::string help;
  std::vector<std::string> words;  ///< values that it takes, as far as they are words
  bool positional = false;
};

struct CommandFacts {
  std::string name;
  std::string about;
  std::vector<FlagFacts>
      flags;  ///< in the order of help; a positional that has a flag is there too
  std::string footer;
};

/// A program as its manual page and shells have it.
struct ProgramFacts {
  std::string name;    ///< "mwmesh"
  std::string does;    ///< in a few words
  std::string called;  ///< what a line begins with that runs it: "mpirun -n N mwmesh-mpi"
  std::string about;   ///< a paragraph
  std::vector<CommandFacts> commands;  ///< none: nobody starts it by hand
  std::vector<std::string> examples;
};

/// Every subcommand that help lists, in its order.
[[nodiscard]] std::vector<CommandFacts> list_commands(const CLI::App& program);

/// Flags without positionals, or those alone.
[[nodiscard]] std::vector<FlagFacts> flags_of(const CommandFacts& command);
[[nodiscard]] std::vector<FlagFacts> positionals_of(const CommandFacts& command);

/// Joined by what goes between.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, const std::string& between);
/// All names of all flags.
[[nodiscard]] std::vector<std::string> names_of(const std::vector<FlagFacts>& flags);
/// With every `from` replaced.
[[nodiscard]] std::string replaced(std::string text, const std::string& from,
                                   const std::string& to);

}  // namespace mw::cli
