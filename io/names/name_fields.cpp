// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in the text of a table of names.
#include "io/names/name_fields.h"

#include <charconv>
#include <cmath>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

template <class T>
std::optional<T> parsed(std::string_view text) {
  T number{};
  const auto [stop, verdict] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (verdict != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string_view without_plus(std::string_view text) {
  return text.starts_with('+') ? text.substr(1) : text;
}

}  // namespace

std::optional<RawLabel> label_of(std::string_view text) {
  text = without_plus(trimmed(text));
  if (text.ends_with(".0")) text.remove_suffix(2);
  if (!text.starts_with('-')) return parsed<std::uint64_t>(text);
  const auto below = parsed<std::int64_t>(text);
  if (!below) return std::nullopt;
  return static_cast<RawLabel>(*below);
}

std::optional<double> number_of(std::string_view text) {
  const auto number = parsed<double>(without_plus(trimmed(text)));
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::uint8_t> byte_of(std::string_view text) {
  return parsed<std::uint8_t>(without_plus(trimmed(text)));
}

std::optional<std::uint8_t> byte_of_share(double share) {
  if (!(share >= 0 && share <= 1)) return std::nullopt;
  return static_cast<std::uint8_t>(std::lround(255 * share));
}

void fail_line(std::string_view file, std::size_t line, std::string_view reason,
               std::string_view way_out) {
  fail_input(file, text("line ", line), reason, way_out);
}

}  // namespace mw::io
