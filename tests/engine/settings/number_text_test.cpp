// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Memory and labels as people write them.
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

const io::LabelNames kNames({{.label = 1, .name = "Lesion"},
                             {.label = 2, .name = "White matter"},
                             {.label = 3, .name = "Air"},
                             {.label = ~RawLabel{0}, .name = "Air"},
                             {.label = 5, .name = "7"}});

TEST(FindLabel, TakesNumbersAndNames) {
  EXPECT_EQ(find_label("Lesion", kNames, false), 1U);
  EXPECT_EQ(find_label(" White matter ", kNames, false), 2U);
  EXPECT_EQ(find_label("7", kNames, false), 7U);
  EXPECT_EQ(find_label("-1", {}, true), ~RawLabel{0});
  EXPECT_EQ(find_label("18446744073709551615", {}, false), ~RawLabel{0});
}

TEST(FindLabel, RefusesWhatIsNoLabelOrSeveral) {
  const auto refusal = [](const char* text, bool is_signed) -> std::string {
    try {
      return "label " + std::to_string(find_label(text, kNames, is_signed));
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal("-1", false), "label -1: labels are not negative");
  EXPECT_EQ(refusal("9223372036854775808", true),
            "label 9223372036854775808: labels are signed, below 2^63");
  EXPECT_THAT(refusal("18446744073709551616", false), testing::HasSubstr("64 bits"));
  EXPECT_EQ(refusal("Air", true), "labels 3, -1 are called 'Air': give the number");
  EXPECT_EQ(refusal("lesion", false),
            "no label is called 'lesion'; there are Lesion, White matter, Air, 7, Air");
  EXPECT_THROW((void)find_label("Lesion", {}, false), Error);
  EXPECT_THROW((void)find_label("1.5", {}, false), Error);
}

}  // namespace
}  // namespace mw::engine
