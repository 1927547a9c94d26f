// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh generate: manual page and completion scripts, for the build; help does not list it.
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

std::string generated(const std::string& what, const std::vector<CommandFacts>& commands) {
  if (what == "man") return manual_page(commands, engine::version());
  if (what == "bash") return bash_completion(commands);
  if (what == "zsh") return zsh_completion(commands);
  if (what == "fish") return fish_completion(commands);
  throw Error(ErrorKind::kUsage, what + ": expected man, bash, zsh or fish");
}

}  // namespace

void add_generate_command(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand(
      "generate", "prints the manual page, or what a shell completes, of all subcommands");
  command->group("");
  const auto what = std::make_shared<std::string>();
  command->add_option("WHAT", *what, "which")->type_name("man|bash|zsh|fish")->required();
  command->callback([what, &program, &chosen] {
    chosen = [what, &program] {
      std::cout << generated(*what, list_commands(program));
      return kExitDone;
    };
  });
}

}  // namespace mw::cli
