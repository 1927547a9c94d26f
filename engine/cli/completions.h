// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What shells complete, from the program's own options.
#pragma once

#include <string>

#include "engine/cli/command_list.h"

namespace mw::cli {

/// Scripts for bash 4, zsh and fish: subcommands, flags, values that are words; files elsewhere.
[[nodiscard]] std::string bash_completion(const ProgramFacts& program);
[[nodiscard]] std::string zsh_completion(const ProgramFacts& program);
[[nodiscard]] std::string fish_completion(const ProgramFacts& program);

}  // namespace mw::cli
