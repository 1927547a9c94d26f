// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values of options from text and back.
#include "engine/cli/values.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <optional>

#include "kernels/core/error.h"

namespace mw::cli {
namespace {

using engine::fail_expected;
using engine::read_all;

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
    parts.push_back(text.substr(0, comma));
    text.remove_prefix(comma + 1);
  }
  parts.push_back(text);
  return parts;
}

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
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  if (whole > (kMost - more) / unit) return {};
  return whole * unit + more;
}

}  // namespace

std::array<double, 3> parse_numbers(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  if (parts.size() != 3) fail_expected("three numbers X,Y,Z", text);
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = parse_number(parts[i]);
  return out;
}

Index3 parse_shape(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  std::array<std::int64_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (parts.size() != 3 || !read_all(parts[i], out[i]) || out[i] < 1) {
      fail_expected("three positive integers X,Y,Z", text);
    }
  }
  return {out[0], out[1], out[2]};
}

Box3 parse_box(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  std::array<std::int64_t, 6> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (parts.size() != out.size() || !read_all(parts[i], out[i])) {
      fail_expected("six integers X0,Y0,Z0,X1,Y1,Z1", text);
    }
  }
  return {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
}

std::vector<RawLabel> parse_labels(std::string_view text) {
  std::vector<RawLabel> labels;
  for (const std::string_view part : split(text)) labels.push_back(parse_label(part));
  return labels;
}

io::Element parse_element(std::string_view text) {
  if (text == "tet4") return io::Element::kTet4;
  if (text == "tet10") return io::Element::kTet10;
  throw Error(ErrorKind::kUsage,
              "'" + std::string(text) + "' is no element; those are tet4 and tet10");
}

std::uint64_t parse_size(std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::optional<std::uint64_t> unit = bytes_of_unit(text.substr(end));
  const std::optional<std::uint64_t> bytes =
      unit ? bytes_of(text.substr(0, end), *unit) : std::nullopt;
  if (!bytes || *bytes == 0) fail_expected("a size such as 512M, 1.5G or 4GiB", text);
  return *bytes;
}

}  // namespace mw::cli
