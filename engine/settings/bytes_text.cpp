// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Amounts of memory from text.
#include "engine/settings/bytes_text.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <string>

#include "engine/settings/number_text.h"

namespace mw::engine {
namespace {

/// Of "", "K", "kib", "KB" and so on.
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

/// number: digits, with a point between them or not.
std::optional<std::uint64_t> bytes_of(std::string_view number, std::uint64_t unit) {
  const std::size_t point = std::min(number.find('.'), number.size());
  std::uint64_t whole = 0;
  double part = 0;
  if (!read_all(number.substr(0, point), whole)) return {};
  if (point < number.size() && !read_all("0" + std::string(number.substr(point)), part)) return {};
  const auto more = static_cast<std::uint64_t>(part * static_cast<double>(unit));
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  if (whole > (kMax - more) / unit) return {};
  return whole * unit + more;
}

}  // namespace

std::uint64_t parse_size(std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::optional<std::uint64_t> unit = bytes_of_unit(text.substr(end));
  const std::optional<std::uint64_t> bytes =
      unit ? bytes_of(text.substr(0, end), *unit) : std::nullopt;
  if (!bytes || *bytes == 0) fail_expected("a size such as 512M, 1.5G or 4GiB", text);
  return *bytes;
}

}  // namespace mw::engine
