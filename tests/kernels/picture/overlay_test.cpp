// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Marks above a picture, pixel by pixel, and letters.
#include "kernels/picture/overlay.h"

#include "tests/testing.h"

namespace mw::picture {
namespace {

constexpr int kWidth = 24, kHeight = 20;
constexpr Colour kRed{200, 10, 20};

/// Returns the rows of a picture that is transparent, with the marks.
std::vector<std::vector<std::uint8_t>> rows_of(const Overlay& marks) {
  std::vector<std::vector<std::uint8_t>> out(kHeight, std::vector<std::uint8_t>(4 * kWidth));
  for (int y = 0; y < kHeight; ++y) marks.blend(y, out[static_cast<std::size_t>(y)]);
  return out;
}

int alpha(const std::vector<std::vector<std::uint8_t>>& rows, int x, int y) {
  return rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(4 * x + 3)];
}

TEST(Overlay, FillsBoxesThatAPictureCuts) {
  Overlay marks;
  marks.add_box(-3, 2, 4, 5, kRed);
  marks.add_box(20, 18, 40, 30, kRed);
  const auto rows = rows_of(marks);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool is_inside = (x < 4 && y >= 2 && y < 5) || (x >= 20 && y >= 18);
      EXPECT_EQ(alpha(rows, x, y), is_inside ? 255 : 0) << x << " " << y;
    }
  }
  EXPECT_EQ(rows[3][1], kRed[1]);
}

TEST(Overlay, LinesAreAsWideAsAsked) {
  Overlay marks;
  marks.add_line({2, 10}, {20, 10}, 4, kRed);
  const auto rows = rows_of(marks);
  int sum = 0;
  for (int y = 0; y < kHeight; ++y) sum += alpha(rows, 11, y);
  EXPECT_EQ(sum, 4 * 255);
  EXPECT_EQ(alpha(rows, 11, 10), 255);
  EXPECT_EQ(alpha(rows, 23, 10), 0);
  // What is half covered keeps half of what is below.
  std::vector<std::uint8_t> row(4 * kWidth, 255);
  Overlay thin;
  thin.add_line({2, 10}, {20, 10}, 1, {55, 55, 55});
  thin.blend(10, row);
  EXPECT_EQ(row[4 * 11], 155);
  EXPECT_EQ(row[4 * 11 + 3], 255);
}

/// A letter that is twice as large has four pixels for each of its pixels.
TEST(Overlay, WritesLettersAtAnyScale) {
  Overlay one, two;
  one.add_text(1, 1, 1, U"R", kRed);
  two.add_text(-2, -6, 2, U"R", kRed);
  const auto small = rows_of(one), large = rows_of(two);
  int inked = 0;
  for (int row = 0; row < kGlyphHeight; ++row) {
    for (int column = 0; column < kGlyphWidth; ++column) {
      const bool is_inked = (glyph_row(U'R', row) >> (kGlyphWidth - 1 - column) & 1) != 0;
      EXPECT_EQ(alpha(small, 1 + column, 1 + row), is_inked ? 255 : 0);
      inked += is_inked ? 1 : 0;
      const int x = 2 * column - 2, y = 2 * row - 6;
      if (x < 0 || y < 0 || y + 1 >= kHeight) continue;
      EXPECT_EQ(alpha(large, x, y), is_inked ? 255 : 0);
      EXPECT_EQ(alpha(large, x + 1, y + 1), is_inked ? 255 : 0);
    }
  }
  EXPECT_GT(inked, 15);
}

TEST(Glyphs, AreAllDifferent) {
  std::set<std::vector<std::uint16_t>> seen;
  std::size_t letters = 0;
  for (char32_t letter = 0x20; letter <= 0xff; ++letter) {
    if (letter >= 0x7f && letter <= 0xa0) continue;
    if (letter == 0xad) continue;  // the soft hyphen
    std::vector<std::uint16_t> rows;
    for (int row = 0; row < kGlyphHeight; ++row) {
      rows.push_back(glyph_row(letter, row));
      EXPECT_LT(rows.back(), 1 << kGlyphWidth);
    }
    seen.insert(rows);
    ++letters;
  }
  EXPECT_EQ(seen.size(), letters);
  for (int row = 0; row < kGlyphHeight; ++row) {
    EXPECT_EQ(glyph_row(U'\u0416', row), glyph_row(U'?', row));
  }
}

TEST(Glyphs, LettersAreThoseOfUtf8) {
  EXPECT_EQ(letters_of("aß€𝄞"), U"aß€𝄞");
  EXPECT_EQ(letters_of("a\xff\xc3"), U"a\ufffd\ufffd");
  EXPECT_EQ(letters_of("\xe2\x82z"), U"\ufffd\ufffdz");
}

}  // namespace
}  // namespace mw::picture
