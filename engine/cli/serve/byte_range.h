// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The part of a file that a request asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace mw::cli {

/// The bytes [begin, end) of a file.
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;

  [[nodiscard]] std::uint64_t size() const { return end - begin; }
  [[nodiscard]] bool empty() const { return begin == end; }
};

/// Returns which bytes of a file of `size` bytes the header Range asks for: "bytes=FIRST-LAST",
/// "bytes=FIRST-" or "bytes=-COUNT".  They are empty where the file has none of them.  Any other
/// header asks for nothing, as RFC 9110 allows, and the whole file is the answer: one of several
/// ranges, which may ask for the file many times over, and one with a number above 64 bits.
[[nodiscard]] std::optional<ByteRange> asked_range(std::string_view header, std::uint64_t size);

}  // namespace mw::cli
