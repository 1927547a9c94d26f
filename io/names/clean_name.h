// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes any bytes a name that every output can hold.
#pragma once

#include <string>
#include <string_view>

namespace mw::io {

/// Longest name that is kept, bytes.
inline constexpr std::size_t kMaxNameBytes = 1000;

/// ENSURES: valid UTF-8 of at most kMaxNameBytes, cut between two characters; without control
/// characters (a blank instead), without characters that XML does not allow (U+FFFD instead, as for
/// bytes that are no UTF-8), without blanks at its ends.  A clean name stays as it is.
[[nodiscard]] std::string clean_name(std::string_view bytes);

}  // namespace mw::io
