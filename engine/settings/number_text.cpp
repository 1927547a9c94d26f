// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers, labels and amounts of memory from text and back.
#include "engine/settings/number_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>

#include "io/file/errors.h"

namespace mw::engine {
namespace {

/// Returns how many bytes a unit stands for: "", "K", "kib", "KB" and so on.
std::optional<std::uint64_t> bytes_of_unit(std::string_view unit) {
  constexpr std::string_view kLetters = "kmgt";
  std::string name;
  for (const char c : unit) {
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (name.empty()) return 1;
  const std::size_t power = kLetters.find(name.front());
  const std::string rest = name.substr(1);
  if (power == kLetters.npos || (!rest.empty() && rest != "b" && rest != "ib")) return {};
  std::uint64_t bytes = 1;
  for (std::size_t i = 0; i <= power; ++i) bytes *= rest == "b" ? 1000U : 1024U;
  return bytes;
}

/// Returns the bytes of this many units; number is digits, with a point between them or not.
std::optional<std::uint64_t> bytes_of(std::string_view number, std::uint64_t unit) {
  const std::size_t point = std::min(number.find('.'), number.size());
  std::uint64_t whole = 0;
  double part = 0;
  if (!read_number(number.substr(0, point), whole)) return {};
  if (point < number.size() && !read_number("0" + std::string(number.substr(point)), part))
    return {};
  const auto more = static_cast<std::uint64_t>(part * static_cast<double>(unit));
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  if (whole > (kMax - more) / unit) return {};
  return whole * unit + more;
}

}  // namespace

void fail_expected(std::string_view expected, std::string_view text) {
  io::fail_usage("expected ", expected, ", got '", text, "'");
}

std::int64_t parse_integer(std::string_view text) {
  std::int64_t value = 0;
  if (!read_number(text, value)) fail_expected("an integer", text);
  return value;
}

double parse_number(std::string_view text) {
  double value = 0;
  if (!read_number(text, value) || !std::isfinite(value)) fail_expected("a finite number", text);
  return value;
}

RawLabel parse_label(std::string_view text) {
  RawLabel label = 0;
  if (read_number(text, label)) return label;
  std::int64_t negative = 0;
  if (!read_number(text, negative)) fail_expected("a label of at most 64 bits", text);
  return static_cast<RawLabel>(negative);
}

bool parse_switch(std::string_view text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  fail_expected("true or false", text);
}

std::uint64_t parse_bytes(std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::optional<std::uint64_t> unit = bytes_of_unit(text.substr(end));
  const std::optional<std::uint64_t> bytes =
      unit ? bytes_of(text.substr(0, end), *unit) : std::nullopt;
  if (!bytes || *bytes == 0) fail_expected("a size such as 512M, 1.5G or 4GiB", text);
  return *bytes;
}

io::CacheFolder parse_cache_folder(std::string_view text) {
  io::CacheFolder out{.path = text};
  const std::size_t comma = text.rfind(',');
  if (comma != text.npos) {
    out = {.path = text.substr(0, comma), .bytes = parse_bytes(text.substr(comma + 1))};
  }
  if (out.path.empty()) fail_expected("a folder, and a size such as 10GiB behind a comma", text);
  return out;
}

std::string format_number(double value) {
  return io::text(value);
}

}  // namespace mw::engine
