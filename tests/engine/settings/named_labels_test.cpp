// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels by number and by name: one rule for one label and for the texts of options.
#include "engine/settings/named_labels.h"

#include <gmock/gmock.h>

#include "kernels/core/error.h"

namespace mw::engine {
namespace {

const io::LabelNames kNames({{.label = 1, .name = "Lesion"},
                             {.label = 2, .name = "White matter"},
                             {.label = 3, .name = "Air"},
                             {.label = ~RawLabel{0}, .name = "Air"},
                             {.label = 5, .name = "7"},
                             {.label = 8, .name = "Twin"},
                             {.label = 9, .name = "twin"}});

TEST(FindLabel, TakesNumbersAndNames) {
  EXPECT_EQ(find_label("Lesion", kNames, false), 1U);
  EXPECT_EQ(find_label(" White matter ", kNames, false), 2U);
  EXPECT_EQ(find_label("7", kNames, false), 7U);
  EXPECT_EQ(find_label(" 7 ", kNames, false), 7U);
  EXPECT_EQ(find_label("\"7\"", kNames, false), 5U);
  EXPECT_EQ(find_label("white MATTER", kNames, false), 2U);
  EXPECT_EQ(find_label("Twin", kNames, false), 8U);
  EXPECT_EQ(find_label("twin", kNames, false), 9U);
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
  EXPECT_EQ(refusal("Air", true), "labels 3, -1 are called 'Air'; give the number");
  EXPECT_EQ(refusal("AIR", false),
            "labels 3, 18446744073709551615 are called 'AIR'; give the number");
  EXPECT_EQ(refusal("lesions", false), "no label is called 'lesions'; near it: Lesion");
  EXPECT_THROW((void)find_label("Lesion", {}, false), Error);
  EXPECT_THROW((void)find_label("1.5", {}, false), Error);
}

/// One label of an option is what find_label() makes of it, as far as it is a name.
TEST(WithNumbers, FollowsTheRuleOfOneLabel) {
  for (const std::string text : {"Lesion", "LESION", "white matter", "\"7\"", "Twin", "twin"}) {
    EXPECT_TRUE(has_names(text)) << text;
    EXPECT_EQ(with_numbers(text, kNames), std::to_string(find_label(text, kNames, false))) << text;
  }
  for (const std::string text : {"7", "-1", "2.5", "*", "@twin", "twin.nii.gz", ""}) {
    EXPECT_FALSE(has_names(text)) << text;
    EXPECT_EQ(with_numbers(text, kNames), text);
  }
  for (const std::string text : {"Air", "lesions", "\"8\""}) {
    EXPECT_THROW((void)with_numbers(text, kNames), Error) << text;
    EXPECT_THROW((void)find_label(text, kNames, false), Error) << text;
  }
  EXPECT_EQ(with_numbers("lesion|2=1,*=4", kNames), "1|2=1,*=4");
  EXPECT_EQ(with_numbers("lesion|*=1vox,*|*=4vox", kNames), "1|*=1vox,*|*=4vox");
  const io::LabelNames odd({{1, "a|b", {}}, {2, "c,d=e", {}}});
  for (const char* const pair : {"\"a|b\"|\"c,d=e\"", "1|\"c,d=e\"", "\"a|b\"|2", "\"a|b\" | 2"}) {
    EXPECT_EQ(with_numbers(pair, odd), "1|2") << pair;
    EXPECT_EQ(with_numbers(std::string(pair) + "=3,\"c,d=e\"=1", odd), "1|2=3,2=1") << pair;
  }
  EXPECT_THROW((void)with_numbers("\"a|b\"|\"c", odd), Error);
}

TEST(CheckSizes, RefusesWhatIsNoNumberBehindTheLastEqualsSign) {
  for (const std::string text : {"", "3", "Lesion=3,*=5", "\"c,d=e\"|2=1,Lesion=3e-1",
                                 "@a=b.csv,4=2", "h=x.nii.gz", "Lesion", "a=b=3", "\"c,d=e\""}) {
    EXPECT_NO_THROW(check_sizes(text)) << text;
  }
  for (const std::string wrong : {"", "nan", "inf", "abc", "1e999", "\"c,d=e\""}) {
    for (const std::string before : {"4=", "Lesion=", "3=1,4=", "\"c,d=e\"=", "a=b="}) {
      for (const std::string after : {"", ",5=2"}) {
        try {
          check_sizes(before + wrong + after);
          ADD_FAILURE() << before + wrong + after;
        } catch (const Error& error) {
          EXPECT_EQ(error.what(), "expected a finite number, got '" + wrong + "'");
        }
      }
    }
  }
}

}  // namespace
}  // namespace mw::engine
