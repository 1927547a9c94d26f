// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What formats with numbers of 32 bits can hold.
#pragma once

#include <cstdint>
#include <string_view>

namespace mw::io {

/// ERRORS: mw::Error(kUsage) when there are more than `most` of `what`.
void check_max(std::string_view file, std::string_view what, std::uint64_t count,
               std::uint64_t max);

}  // namespace mw::io
