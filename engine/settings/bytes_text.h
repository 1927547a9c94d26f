// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Amounts of memory from text.
#pragma once

#include <cstdint>
#include <string_view>

namespace mw::engine {

/// ERRORS: mw::Error(kUsage) saying what was expected.  Bytes: "4096", "512M", "1.5G", "4GiB",
/// "1gb"; K M G T alone or with iB are powers of 1024, with B of 1000.  A fraction of a byte is
/// left off.
[[nodiscard]] std::uint64_t parse_size(std::string_view text);

}  // namespace mw::engine
