// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Text that may be damaged, fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace mw::io {

/// Printable ASCII as it is, other bytes as \xHH; "..." for what is behind `most` bytes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t max);

}  // namespace mw::io
