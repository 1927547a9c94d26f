// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// --threads and --memory, of all subcommands that have them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/cli/option_set.h"

namespace mw::cli {

/// threads: 0 for all cores; memory: empty unless given.  budget: what the memory is, for the help.
void add_resource_options(OptionSet& options, int& threads, std::optional<std::uint64_t>& memory,
                          const std::string& budget);

/// What a chunked volume may keep of its file while labels are read: nothing else needs much then.
[[nodiscard]] std::uint64_t cache_bytes(std::uint64_t memory);

}  // namespace mw::cli
