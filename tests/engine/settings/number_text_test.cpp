// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Amounts of memory as people write them.
#include "engine/settings/number_text.h"

#include <gmock/gmock.h>

#include "kernels/core/error.h"

namespace mw::engine {
namespace {

TEST(ParseBytes, TakesEveryUnitInEveryCase) {
  std::uint64_t binary = 1, decimal = 1;
  for (const char letter : {'K', 'M', 'G', 'T'}) {
    binary *= 1024;
    decimal *= 1000;
    const auto small = static_cast<char>(letter - 'A' + 'a');
    for (const std::string& unit : {std::string(1, letter), std::string(1, small)}) {
      EXPECT_EQ(parse_bytes("3" + unit), 3 * binary) << unit;
      EXPECT_EQ(parse_bytes("3" + unit + "iB"), 3 * binary) << unit;
      EXPECT_EQ(parse_bytes("3" + unit + "IB"), 3 * binary) << unit;
      EXPECT_EQ(parse_bytes("3" + unit + "B"), 3 * decimal) << unit;
      EXPECT_EQ(parse_bytes("3" + unit + "b"), 3 * decimal) << unit;
      EXPECT_EQ(parse_bytes("2.5" + unit), 5 * (binary / 2)) << unit;
      EXPECT_EQ(parse_bytes("0.25" + unit + "iB"), binary / 4) << unit;
    }
  }
  EXPECT_EQ(parse_bytes("4096"), 4096U);
  EXPECT_EQ(parse_bytes("1."), 1U);
  EXPECT_EQ(parse_bytes("0.0015KB"), 1U);
}

TEST(ParseBytes, RefusesWhatIsNone) {
  for (const char* text : {"",          "G",   "0",     "0G",  "-1G", "+1G", "1e3",
                           "1 G",       "1GX", "1GiBs", "1i",  "1B",  ".5G", "1.5.5G",
                           "1..5G",     "1.x", "0.1",   "nan", "inf", "1P",  "18446744073709551616",
                           "16777216T", "1,5G"}) {
    EXPECT_THROW((void)parse_bytes(text), Error) << text;
  }
  EXPECT_EQ(parse_bytes("16777215T"), 16777215ULL << 40U);
  EXPECT_EQ(parse_bytes("18446744073709551615"), ~std::uint64_t{0});
}

}  // namespace
}  // namespace mw::engine
