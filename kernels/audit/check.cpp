// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Wording of a check's detail.
#include "kernels/audit/check.h"

#include <array>
#include <charconv>
#include <cmath>

namespace mw::audit {

std::string Offenders::text() const {
  std::string text = std::to_string(count_) + " " + noun_;
  for (std::size_t i = 0; i < first_.size(); ++i) text += (i == 0 ? " (" : ", ") + first_[i];
  if (count_ > kNamed) text += ", ...";
  return first_.empty() ? text : text + ")";
}

std::string number(double value) {
  constexpr int kDigits = 4;
  constexpr double kAllBeforeThePoint = 1000, kMostBeforeThePoint = 1e15;
  std::array<char, 32> text{};
  char* const end = text.data() + text.size();
  const auto written =
      value == 0 ? std::to_chars(text.data(), end, 0)
      : std::abs(value) >= kAllBeforeThePoint && std::abs(value) < kMostBeforeThePoint
          ? std::to_chars(text.data(), end, value, std::chars_format::fixed, 0)
          : std::to_chars(text.data(), end, value, std::chars_format::general, kDigits);
  return {text.data(), written.ptr};
}

}  // namespace mw::audit
