// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Line by line.
#include "engine/system/proc_file.h"

#include <string>

namespace mw::engine {

std::optional<std::uint64_t> proc_bytes(std::istream& file, std::string_view name) {
  for (std::string line; std::getline(file, line);) {
    const bool found = line.starts_with(name) && line.substr(name.size()).starts_with(':');
    if (found) return std::stoull(line.substr(name.size() + 1)) * 1024;
  }
  return std::nullopt;
}

}  // namespace mw::engine
