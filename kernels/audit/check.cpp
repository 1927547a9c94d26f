// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Wording of a check's detail.
#include "kernels/audit/check.h"

#include <array>
#include <charconv>

namespace mw::audit {

std::string Offenders::text() const {
  std::string text = std::to_string(count_) + " " + noun_;
  for (std::size_t i = 0; i < first_.size(); ++i) text += (i == 0 ? " (" : ", ") + first_[i];
  if (count_ > kNamed) text += ", ...";
  return first_.empty() ? text : text + ")";
}

std::string number(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

}  // namespace mw::audit
