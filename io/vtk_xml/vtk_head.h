// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text of a VTK XML file in front of its appended data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// XML text, which ends behind the start tag of the appended data where the file has such.
struct VtkHead {
  std::string xml;
  /// Where the start tag of the appended data is in the text, and where it is in the file.
  std::optional<std::size_t> tag{};
  std::uint64_t tag_in_file = 0;
};

/// The most bytes of text that are held in memory.
inline constexpr std::uint64_t kMaxVtkTextBytes = std::uint64_t{1} << 33U;

/// Throws mw::Error(kInput) for more text than that.
[[noreturn]] void fail_too_much_text(const std::string& file, std::string_view field);

/// Appends to text, which has the source's bytes from start on, at most `count` of those that
/// follow; false at the end of the source.
[[nodiscard]] bool append_text(const ByteSource& source, std::uint64_t start, std::uint64_t count,
                               std::string& text);

/// Reads the text with all contents.  Memory: the text, of 8 GiB at most.
/// ERRORS: mw::Error(kInput) naming the file, where it is no VTK XML file, also below.
[[nodiscard]] VtkHead read_head(const ByteSource& source);

/// Reads the text with "BEGIN END" for the content of each array: where that is in the file.
/// Memory: 1 MiB, and the tags, which are refused above 64 MiB.
[[nodiscard]] VtkHead read_outline(const ByteSource& source);

}  // namespace mw::io
