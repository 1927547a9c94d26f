// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers at the right of fields of a given width, as formats of punched cards want them.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "kernels/core/assert.h"

namespace mw::io {

/// REQUIRES: the number has no more digits than there are columns.
[[nodiscard]] inline std::string fixed_integer(std::uint64_t number, std::size_t columns) {
  const std::string digits = std::to_string(number);
  MW_ASSERT(digits.size() <= columns);
  return std::string(columns - digits.size(), ' ') + digits;
}

/// In the form 1.5E+000, with as many digits behind the point, and an exponent of two digits or of
/// three.  REQUIRES: columns of 7 and the digits, or of 8; with two |value| < 1e100, or it is
/// longer.
[[nodiscard]] inline std::string fixed_real(double value, std::size_t columns, int digits,
                                            std::size_t exponent = 2) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*E", digits, value);
  std::string out = text.data();
  const std::size_t sign = out.find('E') + 1;
  if (out.size() - sign - 1 < exponent) out.insert(sign + 1, "0");
  return std::string(columns > out.size() ? columns - out.size() : 0, ' ') + out;
}

}  // namespace mw::io
