// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers from and to text, and texts as others need them: without regard to case, as XML has them,
// or fit for a terminal.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/errors.h"

namespace mw::io {

/// Returns the text without blanks (space, tab, carriage return, line feed) at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Returns the parts of the text between blanks.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// Returns the parts before, between and behind the separators; they may be empty.
[[nodiscard]] std::vector<std::string_view> split_at(char separator, std::string_view text);

/// Returns the decimal number that takes the whole word, with or without a + in front; nothing when
/// the word is no number or the type cannot hold it.  Reals may be "nan" and "inf".
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);
[[nodiscard]] std::optional<std::uint64_t> parse_count(std::string_view word);
[[nodiscard]] std::optional<double> parse_real(std::string_view word);

/// Returns the numbers of all words of a text; nothing when one word is no number.
[[nodiscard]] std::optional<std::vector<std::int64_t>> parse_integers(std::string_view text);
[[nodiscard]] std::optional<std::vector<double>> parse_reals(std::string_view text);

/// Returns the shortest decimal that a float stands for, as 1.2 and not 1.2000000476837158, so that
/// a volume has the spacing that its other files have.
[[nodiscard]] double decimal_of(float value);

/// Returns printable ASCII as it is and other bytes as \xHH; "..." stands for all behind max bytes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t max);

/// Returns a value for --memory, rounded up: "97MiB".
[[nodiscard]] inline std::string mebibytes(std::uint64_t bytes) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  return text(bytes / kMebibyte + (bytes % kMebibyte != 0 ? 1 : 0), "MiB");
}

/// Returns a size for a message: "1000 bytes", "64MiB", "57.6MiB" (rounded down).
[[nodiscard]] inline std::string size_words(std::uint64_t bytes) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  if (bytes < kMebibyte) return text(bytes, " bytes");
  const std::uint64_t tenths = bytes % kMebibyte * 10 / kMebibyte;
  return text(bytes / kMebibyte, tenths > 0 ? text(".", tenths) : "", "MiB");
}

/// Returns "it takes at least --memory 97MiB", for where more may turn out to be needed later.
[[nodiscard]] inline std::string min_memory(std::uint64_t bytes) {
  return "it takes at least --memory " + mebibytes(bytes);
}

/// Reals are written with the fewest digits that give back the same double.  A line has room for a
/// dozen of the longest numbers.
class NumberLine {
 public:
  explicit NumberLine(char separator = ' ') : separator_(separator) {}

  template <class T>
  void add(T number) {
    end_ = std::to_chars(end_, chars_.data() + chars_.size(), number).ptr;
    *end_++ = separator_;
  }
  /// Returns the numbers, with `last` for the last separator.  REQUIRES: there is a number.
  [[nodiscard]] std::string_view finish(char last = '\n') {
    end_[-1] = last;
    return {chars_.data(), static_cast<std::size_t>(end_ - chars_.data())};
  }
  /// Returns the numbers with nothing behind the last.  REQUIRES: there is a number.
  [[nodiscard]] std::string_view numbers() const {
    return {chars_.data(), static_cast<std::size_t>(end_ - chars_.data()) - 1};
  }

 private:
  char separator_;
  std::array<char, 320> chars_;
  char* end_ = chars_.data();
};

/// Returns the text as it stands in an attribute in double quotes, or in an element.
[[nodiscard]] inline std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// Returns the text with the letters A to Z in lower case, and all other bytes as they are.
[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

}  // namespace mw::io
