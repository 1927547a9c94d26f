// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers from text and to it, and text that may be damaged, fit for a terminal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/errors.h"

namespace mw::io {

/// The text without blanks (space, tab, carriage return, line feed) at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// What blanks part.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// A decimal number that takes the whole word, a + in front allowed; empty when it is none or does
/// not fit.  Reals may be "nan" and "inf".
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);
[[nodiscard]] std::optional<double> parse_real(std::string_view word);

/// The same of all words; empty when one is no number.
[[nodiscard]] std::optional<std::vector<std::int64_t>> parse_integers(std::string_view text);
[[nodiscard]] std::optional<std::vector<double>> parse_reals(std::string_view text);

/// The shortest decimal that a float stands for: 1.2, not 1.2000000476837158, so that a volume has
/// the spacing that its other files have.
[[nodiscard]] double decimal_of(float value);

/// Printable ASCII as it is, other bytes as \xHH; "..." for what is behind `most` bytes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t max);

/// "97MiB", rounded up: a value for --memory.
[[nodiscard]] inline std::string mebibytes(std::uint64_t bytes) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  return text(bytes / kMebibyte + (bytes % kMebibyte != 0 ? 1 : 0), "MiB");
}

/// "the least that works is --memory 97MiB".
[[nodiscard]] inline std::string min_memory(std::uint64_t bytes) {
  return "the least that works is --memory " + mebibytes(bytes);
}

}  // namespace mw::io
