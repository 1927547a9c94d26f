// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Letters as strokes, which are drawn into rows of pixels once.
#include "kernels/picture/glyphs.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace mw::picture {
namespace {

/// Strokes from point to point, parted by spaces.  A point is its column, a digit, and its row, a
/// letter: capitals stand from c to l, small letters from f to l, and tails reach down to o.
/// A letter and a mark stand for that letter with that accent (kAccents).
constexpr std::array<std::string_view, 95> kAscii{"",
                                                  "4c4i 4l",
                                                  "3c3e 5c5e",
                                                  "3d3k 5d5k 1f7f 1i7i",
                                                  "7d6c2c1d1e2f6g7h7i6j2j1i 4b4k",
                                                  "2c1d1e2f3e3d2c 7c1l 6i5j5k6l7k7j6i",
                                                  "7l2e2d3c4c5d5e1i1k2l4l7i",
                                                  "4c4e",
                                                  "5b3d3k5m",
                                                  "3b5d5k3m",
                                                  "4e4k 2f6j 6f2j",
                                                  "4e4k 1h7h",
                                                  "4k4l3n",
                                                  "1h7h",
                                                  "4k4l 5k5l",
                                                  "7c1l",
                                                  "3c5c7e7j5l3l1j1e3c 5f3i",
                                                  "2e4c4l 2l6l",
                                                  "1e1d2c6c7d7f1l7l",
                                                  "1d2c6c7d7f6g3g 6g7h7k6l2l1k",
                                                  "6l6c1i7i",
                                                  "7c1c1g2f5f7h7j5l2l1k",
                                                  "6c4c1f1j3l5l7j7i5g3g1i",
                                                  "1c7c7d3l",
                                                  "2c6c7d7f6g2g1f1d2c 2g1h1k2l6l7k7h6g",
                                                  "7f5h3h1f1e3c5c7e7i4l2l",
                                                  "4f5f5g4g4f 4k5k5l4l4k",
                                                  "4f5f5g4g4f 4k4l3n",
                                                  "6d2h6l",
                                                  "1f7f 1i7i",
                                                  "2d6h2l",
                                                  "1e1d2c6c7d7e4h4i 4l",
                                                  "6i5j4j3i3h4g5g6h6j7j7e5c3c1e1j3l6l",
                                                  "1l1f4c7f7l 1i7i",
                                                  "1l1c5c7d7f5g1g 5g7i7j5l1l",
                                                  "7d6c3c1e1j3l6l7k",
                                                  "1c4c7f7i4l1l1c",
                                                  "7c1c1l7l 1g5g",
                                                  "7c1c1l 1g5g",
                                                  "7d6c3c1e1j3l5l7j7h4h",
                                                  "1c1l 7c7l 1g7g",
                                                  "2c6c 4c4l 2l6l",
                                                  "3c7c 6c6j4l3l1j",
                                                  "1c1l 7c1i 3g7l",
                                                  "1c1l7l",
                                                  "1l1c4g7c7l",
                                                  "1l1c7l7c",
                                                  "3c5c7e7j5l3l1j1e3c",
                                                  "1l1c5c7d7f5g1g",
                                                  "3c5c7e7j5l3l1j1e3c 4i7m",
                                                  "1l1c5c7d7f5g1g 3g7l",
                                                  "7d6c2c1d1e2f6h7i7k6l2l1k",
                                                  "1c7c 4c4l",
                                                  "1c1j3l5l7j7c",
                                                  "1c1f4l7f7c",
                                                  "1c2l4g6l7c",
                                                  "1c7l 7c1l",
                                                  "1c4g7c 4g4l",
                                                  "1c7c1l7l",
                                                  "5b3b3m5m",
                                                  "1c7l",
                                                  "3b5b5m3m",
                                                  "2e4c6e",
                                                  "1n7n",
                                                  "3b5d",
                                                  "2f5f7h7l 7i2i1j1k2l5l7j",
                                                  "1c1l 1h3f5f7h7j5l3l1j",
                                                  "7g6f3f1h1j3l6l7k",
                                                  "7c7l 7h5f3f1h1j3l5l7j",
                                                  "1i7i7h5f3f1h1j3l6l",
                                                  "6c5c4d4l 2g6g",
                                                  "7f7m5o2o 7h5f3f1h1i3k5k7i",
                                                  "1c1l 1h3f5f7h7l",
                                                  "3f4f4l 2l6l 4c",
                                                  "4f5f5m4o2o 5c",
                                                  "1c1l 6f1j 3i6l",
                                                  "3c4c4l 2l6l",
                                                  "1f1l 1g2f3f4g4l 4g5f6f7g7l",
                                                  "1f1l 1h3f5f7h7l",
                                                  "3f5f7h7j5l3l1j1h3f",
                                                  "1f1o 1h3f5f7h7j5l3l1j",
                                                  "7f7o 7h5f3f1h1j3l5l7j",
                                                  "2f2l 2h4f6f7g",
                                                  "7g6f2f1g2h6i7j7k6l2l1k",
                                                  "4c4k5l6l7k 2f6f",
                                                  "1f1j3l5l7j 7f7l",
                                                  "1f4l7f",
                                                  "1f2l4h6l7f",
                                                  "1f7l 7f1l",
                                                  "1f4l 7f3n2o",
                                                  "1f7f1l7l",
                                                  "6b5b4c4f3h4j4l5m6m",
                                                  "4b4n",
                                                  "2b3b4c4f5h4j4l3m2m",
                                                  "1h2g3g5i6i7h"};

/// The letters U+00A0 to U+00FF.
constexpr std::array<std::string_view, 96> kLatin{"",
                                                  "4f 4i4o",
                                                  "7g6f3f1h1j3l6l7k 4d4n",
                                                  "6d5c4c3d3l 1l7l 1g5g",
                                                  "3f5f6g6i5j3j2i2g3f 1e2f 7e6f 1k2j 7k6j",
                                                  "1c4g7c 4g4l 2h6h 2j6j",
                                                  "4b4f 4i4m",
                                                  "6c3c2d2e6h6j5k 6i2f2h6k6l5m2m",
                                                  "2d 6d",
                                                  "3c5c7e7j5l3l1j1e3c 5f4f3g3h4i5i",
                                                  "2c4c5d5g 5e3e2f3g5g 2i5i",
                                                  "4f1i4l 7f4i7l",
                                                  "1h7h7k",
                                                  "3h5h",
                                                  "3c5c7e7j5l3l1j1e3c 3i3f5f5g3g 4g5i",
                                                  "1c7c",
                                                  "3b5b6c6d5e3e2d2c3b",
                                                  "4d4j 1g7g 1l7l",
                                                  "2c3b4b5c2g5g",
                                                  "2b5b3d5e5f4g2g",
                                                  "3d5b",
                                                  "1f1o 1j3l5l7j 7f7l",
                                                  "7c7l 5l5c3c1e1f3g5g 3e4e",
                                                  "4h5h",
                                                  "4l5m4o3o",
                                                  "3c4b4g 3g5g",
                                                  "2d4b6d4f2d 2i6i",
                                                  "1f4i1l 4f7i4l",
                                                  "1b1f 7c1l 5h5j7j 7h7l",
                                                  "1b1f 7c1l 4i5h7h7i4l7l",
                                                  "1b3b2d3e2f1f 7c1l 5h5j7j 7h7l",
                                                  "4f 4i4j1m1n2o6o7n",
                                                  "A`",
                                                  "A'",
                                                  "A^",
                                                  "A~",
                                                  "A:",
                                                  "Ao",
                                                  "1l1e3c7c 4c4l7l 1h6h",
                                                  "C,",
                                                  "E`",
                                                  "E'",
                                                  "E^",
                                                  "E:",
                                                  "I`",
                                                  "I'",
                                                  "I^",
                                                  "I:",
                                                  "1c4c7f7i4l1l1c 1g4g",
                                                  "N~",
                                                  "O`",
                                                  "O'",
                                                  "O^",
                                                  "O~",
                                                  "O:",
                                                  "2e6k 6e2k",
                                                  "3c5c7e7j5l3l1j1e3c 7c1l",
                                                  "U`",
                                                  "U'",
                                                  "U^",
                                                  "U:",
                                                  "Y'",
                                                  "1c1l 1e5e7g7h5j1j",
                                                  "1l1e3c5c6d6f4g7i7k6l3l",
                                                  "a`",
                                                  "a'",
                                                  "a^",
                                                  "a~",
                                                  "a:",
                                                  "ao",
                                                  "2f3f4g4k3l2l1k1j2i7i7h6f5f4g 4k5l6l7k",
                                                  "c,",
                                                  "e`",
                                                  "e'",
                                                  "e^",
                                                  "e:",
                                                  "i`",
                                                  "i'",
                                                  "i^",
                                                  "i:",
                                                  "3c7g7j5l3l1j1i3g6g 6c2e",
                                                  "n~",
                                                  "o`",
                                                  "o'",
                                                  "o^",
                                                  "o~",
                                                  "o:",
                                                  "4e 1h7h 4k",
                                                  "3f5f7h7j5l3l1j1h3f 7f1l",
                                                  "u`",
                                                  "u'",
                                                  "u^",
                                                  "u:",
                                                  "y'",
                                                  "1c1o 1h3f5f7h7j5l3l1j",
                                                  "y:"};

struct Accent {
  char mark = 0;
  std::string_view strokes;  ///< over capitals
};
constexpr std::array kAccents{Accent{'`', "3a4b"},      Accent{'\'', "5a4b"},
                              Accent{'^', "3b4a5b"},    Accent{'~', "2b3a5b6a"},
                              Accent{':', "2a2b 6a6b"}, Accent{'o', "3a5a 3b5b"},
                              Accent{',', "4l5m4o3o"}};
constexpr int kLowerBySmall = 2;  ///< how many rows lower an accent is over small letters

using Rows = std::array<std::uint16_t, kGlyphHeight>;

struct Dot {
  int column = 0;
  int row = 0;
};

void ink(Dot dot, Rows& rows) {
  rows[static_cast<std::size_t>(dot.row)] |=
      static_cast<std::uint16_t>(1U << static_cast<unsigned>(kGlyphWidth - 1 - dot.column));
}

/// Returns the whole number nearest to a quotient; halves go up.  REQUIRES: divisor > 0, and a
/// quotient above -kGlyphHeight.
int rounded(int number, int divisor) {
  return (2 * (number + kGlyphHeight * divisor) + divisor) / (2 * divisor) - kGlyphHeight;
}

void ink_line(Dot from, Dot to, Rows& rows) {
  const int across = to.column - from.column, down = to.row - from.row;
  const int steps = std::max({std::abs(across), std::abs(down), 1});
  for (int i = 0; i <= steps; ++i) {
    ink({from.column + rounded(i * across, steps), from.row + rounded(i * down, steps)}, rows);
  }
}

void ink_strokes(std::string_view strokes, int lower, Rows& rows) {
  for (std::size_t at = 0, first = 0; at + 1 < strokes.size(); at += 2) {
    if (strokes[at] == ' ') first = ++at;
    const auto dot_at = [&](std::size_t i) {
      return Dot{strokes[i] - '0', strokes[i + 1] - 'a' + lower};
    };
    ink_line(dot_at(at == first ? at : at - 2), dot_at(at), rows);
  }
}

bool is_small(char letter) {
  return letter >= 'a' && letter <= 'z';
}

/// Returns the strokes of a letter under an accent: an i loses its dot.
std::string_view under_accent(char letter) {
  const std::string_view strokes = kAscii[static_cast<std::size_t>(letter - ' ')];
  return letter == 'i' ? strokes.substr(0, strokes.rfind(' ')) : strokes;
}

Rows drawn(std::string_view glyph) {
  Rows rows{};
  if (glyph.size() != 2 || glyph[0] <= '9') {
    ink_strokes(glyph, 0, rows);
    return rows;
  }
  ink_strokes(under_accent(glyph[0]), 0, rows);
  for (const Accent& accent : kAccents) {
    if (accent.mark != glyph[1]) continue;
    const bool is_lower = is_small(glyph[0]) && accent.mark != ',';
    ink_strokes(accent.strokes, is_lower ? kLowerBySmall : 0, rows);
  }
  return rows;
}

/// All letters, drawn.
class Glyphs {
 public:
  Glyphs() {
    std::transform(kAscii.begin(), kAscii.end(), ascii_.begin(), drawn);
    std::transform(kLatin.begin(), kLatin.end(), latin_.begin(), drawn);
  }

  [[nodiscard]] const Rows& of(char32_t letter) const {
    if (letter >= 0x20 && letter < 0x7f) return ascii_[letter - 0x20];
    if (letter >= 0xa0 && letter <= 0xff) return latin_[letter - 0xa0];
    return ascii_['?' - 0x20];
  }

 private:
  std::array<Rows, kAscii.size()> ascii_{};
  std::array<Rows, kLatin.size()> latin_{};
};

/// Returns how many bytes a character has that begins so; 0 if none does.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

}  // namespace

std::uint16_t glyph_row(char32_t letter, int row) {
  static const Glyphs glyphs;
  return glyphs.of(letter)[static_cast<std::size_t>(row)];
}

std::u32string letters_of(std::string_view text) {
  std::u32string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t length = length_of(first);
    char32_t letter = length == 1 ? first : first & (0x7fU >> length);
    bool is_whole = length > 0 && at + length <= text.size();
    for (std::size_t i = 1; is_whole && i < length; ++i) {
      const auto next = static_cast<unsigned char>(text[at + i]);
      is_whole = (next & 0xc0U) == 0x80U;
      letter = letter << 6U | (next & 0x3fU);
    }
    out += is_whole ? letter : U'\ufffd';
    at += is_whole ? length : 1;
  }
  return out;
}

}  // namespace mw::picture
