// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The manual page, from the program's own options.
#pragma once

#include <string>
#include <vector>

#include "engine/cli/command_list.h"

namespace mw::cli {

/// mwmesh(1) in the macros of man(7): ASCII, no date.
[[nodiscard]] std::string manual_page(const std::vector<CommandFacts>& commands,
                                      const std::string& version);

}  // namespace mw::cli
