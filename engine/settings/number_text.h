// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers, labels and amounts of memory of settings and options from text and back; and what a
// mistyped word was probably meant to be.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/read_number.h"
#include "io/remote/disk_cache.h"
#include "kernels/core/label.h"

namespace mw::engine {

using io::read_number;

/// All of these take the whole text.  ERRORS: mw::Error(kUsage) saying what was expected.
[[nodiscard]] std::int64_t parse_integer(std::string_view text);
[[nodiscard]] double parse_number(std::string_view text);   ///< finite
[[nodiscard]] RawLabel parse_label(std::string_view text);  ///< negative: two's complement
[[nodiscard]] bool parse_switch(std::string_view text);     ///< "true", "false", "1", "0"
/// Returns the bytes of "4096", "512M", "1.5G", "4GiB" or "1gb".  K, M, G and T are powers of 1024,
/// alone or with iB, and of 1000 with B.  A fraction of a byte is left off.
[[nodiscard]] std::uint64_t parse_bytes(std::string_view text);

/// Parses "DIR", or "DIR,SIZE" with the most bytes that it may have.  What is behind the last comma
/// must be a size, so a folder with a comma in its name needs one.
[[nodiscard]] io::CacheFolder parse_cache_folder(std::string_view text);

/// Returns the shortest decimal that reads back as the same double.
[[nodiscard]] std::string format_number(double value);

/// Throws mw::Error(kUsage): "expected EXPECTED, got 'TEXT'".
[[noreturn]] void fail_expected(std::string_view expected, std::string_view text);

/// Returns words that differ from this one by at most a third of its letters or two, or of which
/// one begins with the other (3 letters or more), the nearest first.  Capitals do not count.
/// Cost: letters of all words times letters of this one.
[[nodiscard]] std::vector<std::string> near_words(std::string_view word,
                                                  const std::vector<std::string>& words);

/// Returns "; did you mean mesh?" about the nearest word, or nothing if none is near.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& words);

}  // namespace mw::engine
