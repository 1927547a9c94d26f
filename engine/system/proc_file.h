// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Amounts of memory in files of /proc.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string_view>

namespace mw::engine {

/// In bytes, the amount in the line "NAME: N kB" of a file like /proc/meminfo or
/// /proc/self/status; empty when there is no such line.
[[nodiscard]] std::optional<std::uint64_t> proc_bytes(std::istream& file, std::string_view name);

}  // namespace mw::engine
