// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in words for people.
#include "engine/report/figures.h"

#include <array>
#include <charconv>

#include "kernels/audit/check.h"

namespace mw::report {

std::string format_bytes(std::uint64_t bytes) {
  return format_fixed(static_cast<double>(bytes) / (1 << 20), 1) + " MiB";
}

std::string format_fixed(double value, int digits) {
  std::array<char, 400> text{};  // the longest double has 309 digits before the point
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits)
          .ptr;
  const std::string out(text.data(), end);
  return out.find_first_not_of("-0.") == out.npos && out.starts_with('-') ? out.substr(1) : out;
}

std::string format_percent(double share, int digits) {
  return format_fixed(100 * share, digits) + " %";
}

std::string format_figure(double value) {
  return audit::number(value);
}

std::string format_volume(double volume, const std::string& unit) {
  constexpr double kCubicMillimetres = 1000;  // of a millilitre
  if (unit == "mm" && volume >= kCubicMillimetres) {
    return format_figure(volume / kCubicMillimetres) + " mL";
  }
  return format_figure(volume) + (unit.empty() ? "" : " " + unit + "3");
}

}  // namespace mw::report
