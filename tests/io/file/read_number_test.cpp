// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers are read as std::from_chars() reads them, by C's functions, too.
#include "io/file/read_number.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "tests/testing.h"

namespace mw::io {
namespace {

/// What from_chars() makes of all of the text; nothing where it refuses it.
std::optional<std::uint64_t> expected(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return std::bit_cast<std::uint64_t>(value);
}

std::optional<std::uint64_t> found(std::string_view text) {
  double value = 0;
  if (!read_real_by_c(text, value)) return std::nullopt;
  return std::bit_cast<std::uint64_t>(value);
}

TEST(ReadNumber, RealsByCAreThoseOfTheLibrary) {
  for (const std::string_view text : {"",
                                      " 1",
                                      "1 ",
                                      "+1",
                                      "-+1",
                                      "0x10",
                                      "-0x1p3",
                                      "1e",
                                      "1e+",
                                      "1e5",
                                      "1E-5",
                                      ".5",
                                      "5.",
                                      ".",
                                      "-",
                                      "-.5e1",
                                      "inf",
                                      "-inf",
                                      "INF",
                                      "infinity",
                                      "1e999",
                                      "-1e999",
                                      "1e-999",
                                      "1,5",
                                      "1_0",
                                      "--1",
                                      "e5",
                                      "0.1",
                                      "123456789012345678901234567890",
                                      "in",
                                      "1f",
                                      "-0"}) {
    EXPECT_EQ(found(text), expected(text)) << text;
  }
  EXPECT_EQ(found(std::string_view("1\0", 2)), std::nullopt);
}

TEST(ReadNumber, RandomRealsByCAreThoseOfTheLibrary) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = std::uint64_t{random()} << 32U | random();
    const auto value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) continue;
    std::array<char, 40> text{};
    const char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    EXPECT_EQ(found({text.data(), end}), bits);
  }
}

TEST(ReadNumber, IntegersThatDoNotFitAreNone) {
  std::int8_t small = 0;
  EXPECT_TRUE(read_number("-128", small));
  EXPECT_EQ(small, -128);
  EXPECT_FALSE(read_number("128", small));
  EXPECT_FALSE(read_number("+1", small));
  EXPECT_FALSE(read_number("", small));
  EXPECT_EQ(small, -128);
}

}  // namespace
}  // namespace mw::io
