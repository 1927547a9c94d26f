// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in fields of a given width, as formats of punched cards want them.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/file/errors.h"
#include "kernels/core/assert.h"

namespace mw::io {

/// The largest number of a node, an element or a group in fixed fields: it has 8 digits.
inline constexpr std::int64_t kMaxFieldNumber = 99'999'999;

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
  // Unlike printf, to_chars has a point in every locale that the host program may have set.
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::scientific, digits);
  std::string out(text.data(), end.ptr);
  std::replace(out.begin(), out.end(), 'e', 'E');
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
  fail_usage(file, ": ", value, " has too large an exponent for ", columns,
             " columns; choose another unit or format");
}

/// Returns the shortest text that reads back as the same number where that fits into the columns,
/// else as many digits as do.  REQUIRES: at least 8 columns.
[[nodiscard]] inline std::string real_within(double value, std::size_t columns) {
  constexpr int kAllDigits = 17;
  MW_ASSERT(columns >= 8);
  std::array<char, 32> chars{};
  char* end = std::to_chars(chars.data(), chars.data() + chars.size(), value).ptr;
  for (int digits = kAllDigits; end - chars.data() > static_cast<std::ptrdiff_t>(columns);) {
    end = std::to_chars(chars.data(), chars.data() + chars.size(), value,
                        std::chars_format::general, --digits)
              .ptr;
  }
  return {chars.data(), end};
}

/// Returns a number for a deck of Abaqus.  CalculiX reads 20 characters of a number and nothing
/// behind them, not even an exponent.  13 digits or more are kept, 14 unless the exponent has
/// three.
[[nodiscard]] inline std::string inp_real(double value) {
  constexpr std::size_t kColumns = 20;
  return real_within(value, kColumns);
}

}  // namespace mw::io
