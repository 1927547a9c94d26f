// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Manual pages, from the program's own options.
#pragma once

#include <string>

#include "engine/cli/command_list.h"

namespace mw::cli {

/// Its page of section 1 in the macros of man(7): ASCII, no date.
[[nodiscard]] std::string manual_page(const ProgramFacts& program, const std::string& version);

}  // namespace mw::cli
