// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers from text, and text that may be damaged.
#include "io/file/text_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "io/file/read_number.h"

namespace mw::io {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

template <class T>
std::optional<T> parse(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  T number{};
  return read_number(word, number) ? std::optional(number) : std::nullopt;
}

template <class T>
std::optional<std::vector<T>> parse_all(std::string_view text) {
  std::vector<T> numbers;
  for (const std::string_view word : words_of(text)) {
    const std::optional<T> number = parse<T>(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::vector<std::string_view> split_at(char separator, std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  return parse<std::int64_t>(word);
}

std::optional<std::uint64_t> parse_count(std::string_view word) {
  return parse<std::uint64_t>(word);
}

std::optional<double> parse_real(std::string_view word) {
  return parse<double>(word);
}

std::optional<std::vector<std::int64_t>> parse_integers(std::string_view text) {
  return parse_all<std::int64_t>(text);
}

std::optional<std::vector<double>> parse_reals(std::string_view text) {
  return parse_all<double>(text);
}

double decimal_of(float value) {
  if (!std::isfinite(value)) return static_cast<double>(value);
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double out = 0;
  (void)read_number({text.data(), end}, out);
  return out;
}

std::string printable(std::string_view text, std::size_t max) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (const char character : text.substr(0, max)) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte >= 0x20 && byte < 0x7f) {
      out += character;
    } else {
      out.append("\\x").append({kDigits[byte >> 4U], kDigits[byte & 15U]});
    }
  }
  return text.size() > max ? out + "..." : out;
}

}  // namespace mw::io
