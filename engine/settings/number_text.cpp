// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers, labels and amounts of memory from text and back, and words that are near others.
#include "engine/settings/number_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
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
  if (!read_all(number.substr(0, point), whole)) return {};
  if (point < number.size() && !read_all("0" + std::string(number.substr(point)), part)) return {};
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
  if (!read_all(text, value)) fail_expected("an integer", text);
  return value;
}

double parse_number(std::string_view text) {
  double value = 0;
  if (!read_all(text, value) || !std::isfinite(value)) fail_expected("a finite number", text);
  return value;
}

RawLabel parse_label(std::string_view text) {
  RawLabel label = 0;
  if (read_all(text, label)) return label;
  std::int64_t negative = 0;
  if (!read_all(text, negative)) fail_expected("a label of at most 64 bits", text);
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

namespace {

std::string lower(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Returns how many letters are added, left out or replaced on the shortest way from a to b.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t before = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = before + (a[i] == b[j] ? 0 : 1);
      before = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, before + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> near_words(std::string_view word, const std::vector<std::string>& words) {
  constexpr std::size_t kLeastBeginning = 3;
  const std::string meant = lower(word);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& known : words) {
    const std::string other = lower(known);
    const bool begins = std::min(meant.size(), other.size()) >= kLeastBeginning &&
                        (other.starts_with(meant) || meant.starts_with(other));
    const std::size_t off = distance(meant, other);
    // Two letters that changed places count as two that are replaced.
    if (begins || off <= std::max<std::size_t>(meant.size() / 3, 2)) near.emplace_back(off, known);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> out;
  for (auto& [off, known] : near) out.push_back(std::move(known));
  return out;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& words) {
  const std::vector<std::string> near = near_words(word, words);
  return near.empty() ? "" : "; did you mean " + near.front() + "?";
}

}  // namespace mw::engine
