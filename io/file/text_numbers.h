// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers from and to text, and how damaged text is made fit for a terminal.
#pragma once

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

}  // namespace mw::io
