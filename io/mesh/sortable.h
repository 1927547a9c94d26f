// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Coordinates as integers, for sorts to compare.
#pragma once

#include <bit>
#include <cstdint>

namespace mw::io {

/// Returns an integer that orders like the double; -0.0 is as 0.0, and NaN has a place, too.
[[nodiscard]] inline std::uint64_t sortable(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
  return (bits >> 63) != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}

}  // namespace mw::io
