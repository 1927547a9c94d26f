// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Letters for pictures, of one width.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mw::picture {

inline constexpr int kGlyphWidth = 9;
inline constexpr int kGlyphHeight = 15;

/// Returns a row of a letter of Latin-1, its leftmost pixel in bit 8.  What is no letter of Latin-1
/// looks like a question mark.  REQUIRES: row from 0 to kGlyphHeight - 1.
[[nodiscard]] std::uint16_t glyph_row(char32_t letter, int row);

/// Returns the characters of a text in UTF-8; bytes that are none become U+FFFD.
[[nodiscard]] std::u32string letters_of(std::string_view text);

}  // namespace mw::picture
