// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers at the right of fields of a given width, as formats of punched cards want them.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "io/file/errors.h"
#include "kernels/core/assert.h"

namespace mw::io {

/// Returns the number at the right of a field.  REQUIRES: it has no more digits than columns.
[[nodiscard]] inline std::string fixed_integer(std::uint64_t number, std::size_t columns) {
  const std::string digits = std::to_string(number);
  MW_ASSERT(digits.size() <= columns);
  return std::string(columns - digits.size(), ' ') + digits;
}

/// Returns the value at the right of a field, in the form 1.5E+000, with `digits` digits behind the
/// point and at least `exponent` of the exponent, 2 or 3.  The text may be longer than the field
/// where columns < digits + 5 + the digits of the exponent.
[[nodiscard]] inline std::string fixed_real(double value, std::size_t columns, int digits,
                                            std::size_t exponent = 2) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*E", digits, value);
  std::string out = text.data();
  const std::size_t sign = out.find('E') + 1;
  if (out.size() - sign - 1 < exponent) out.insert(sign + 1, "0");
  return std::string(columns > out.size() ? columns - out.size() : 0, ' ') + out;
}

/// Returns a coordinate like fixed_real(), which needs no more than these columns.
/// ERRORS: mw::Error(kUsage) naming the file where the exponent is too large for them.
[[nodiscard]] inline std::string fixed_coordinate(std::string_view file, double value,
                                                  std::size_t columns, int digits) {
  std::string out = fixed_real(value, columns, digits);
  if (out.size() <= columns) return out;
  throw Error(ErrorKind::kUsage, text(file, ": ", value, " has too large an exponent for ", columns,
                                      " columns; choose another unit or format"));
}

}  // namespace mw::io
