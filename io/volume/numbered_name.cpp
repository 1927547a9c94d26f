// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parses patterns of names, and puts numbers in.
#include "io/volume/numbered_name.h"

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

constexpr std::int64_t kMaxNameWidth = 32;

}  // namespace

NumberedName::NumberedName(std::string_view pattern, std::string_view file,
                           std::string_view field) {
  const std::size_t mark = pattern.find('%');
  const std::size_t end = pattern.find_first_of("diu", mark);
  const auto fail = [&] {
    fail_input(file, field, text("'", pattern, "' is no pattern with one %d"),
               "give it as in slice%03d.raw");
  };
  if (mark == pattern.npos || end == pattern.npos) fail();
  const std::string_view width = pattern.substr(mark + 1, end - mark - 1);
  if (!width.empty()) {
    const auto number = parse_integer(width);
    if (!number || *number < 0 || *number > kMaxNameWidth) fail();
    width_ = static_cast<std::size_t>(*number);
  }
  before_ = pattern.substr(0, mark);
  has_zeros_ = width.starts_with('0');
  behind_ = pattern.substr(end + 1);
  if (behind_.find('%') != std::string::npos) fail();
}

std::string NumberedName::with(std::int64_t number) const {
  std::string digits = std::to_string(number);
  if (digits.size() < width_) digits.insert(0, width_ - digits.size(), has_zeros_ ? '0' : ' ');
  return text(before_, digits, behind_);
}

}  // namespace mw::io
