// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Coordinates as numbers that sorts compare.
#pragma once

#include <bit>
#include <cstdint>

namespace mw::io {

/// Bits that order like the double they stand for; a total order, whatever the double.
[[nodiscard]] inline std::uint64_t sortable(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
  return (bits >> 63) != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}

}  // namespace mw::io
