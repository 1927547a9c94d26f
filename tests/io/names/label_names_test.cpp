// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names as a table: order, search, merging; and what cleaning leaves of any bytes.
#include "io/names/label_names.h"

#include <map>
#include <nlohmann/json.hpp>

#include "tests/io/names/random_names.h"

namespace mw::io {
namespace {

TEST(CleanName, AnyBytesBecomeUtf8WithoutControls) {
  std::mt19937 random(31);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes;
    for (std::size_t n = below(random, 40); n > 0; --n) {
      // Bytes that begin and continue characters, more often than others.
      const std::size_t kind = below(random, 4);
      const auto any = static_cast<unsigned>(random());
      bytes.push_back(static_cast<char>(kind == 0   ? 0x80U | (any & 0x3FU)
                                        : kind == 1 ? 0xC0U | (any & 0x3FU)
                                                    : any & 0xFFU));
    }
    const std::string clean = clean_name(bytes);
    EXPECT_EQ(clean_name(clean), clean);
    // Throws where it is no UTF-8.
    EXPECT_NO_THROW(static_cast<void>(nlohmann::json(clean).dump()));
    for (const char c : clean) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    EXPECT_FALSE(clean.starts_with(' ') || clean.ends_with(' '));
  }
}

TEST(CleanName, KeepsWhatIsClean) {
  for (const char* name : {"", "a", "Left-Cerebral_White.Matter 7", "\"<&>'\\", "Größe 漢字"}) {
    EXPECT_EQ(clean_name(name), name);
  }
  EXPECT_EQ(clean_name(" \ta\nb\x7F\xC2\x85 "), "a b");
  EXPECT_EQ(clean_name("a\xFF\xEF\xBF\xBF"), "a\xEF\xBF\xBD\xEF\xBF\xBD");
  // Overlong, a surrogate, beyond the last character, cut.
  for (const char* bad : {"\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE6\xBC"}) {
    EXPECT_TRUE(clean_name(bad).starts_with("\xEF\xBF\xBD")) << bad;
  }
}

TEST(CleanName, CutsLongNamesBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 1000; ++i) name += "漢";
  EXPECT_EQ(clean_name(name), name.substr(0, 999));
  EXPECT_EQ(clean_name(std::string(5000, 'x')), std::string(kMaxNameBytes, 'x'));
}

TEST(LabelNames, FindsWhatAMapFinds) {
  std::mt19937 random(32);
  for (int i = 0; i < 300; ++i) {
    std::map<RawLabel, LabelName> expected;
    std::vector<LabelName> rows;
    for (std::size_t n = below(random, 30); n > 0; --n) {
      const LabelName row{below(random, 20), random_name(random), random_colour(random)};
      rows.push_back(row);
      if (row.name.empty() && !row.colour) continue;
      expected[row.label] = row;
    }
    const LabelNames names(rows);
    ASSERT_EQ(names.rows().size(), expected.size());
    EXPECT_EQ(names.empty(), expected.empty());
    for (RawLabel label = 0; label < 21; ++label) {
      const LabelName* found = names.find(label);
      ASSERT_EQ(found != nullptr, expected.contains(label));
      EXPECT_TRUE(found == nullptr || *found == expected[label]);
    }
  }
}

TEST(LabelNames, OthersWinPartByPart) {
  const Colour red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  const LabelNames file({{1, "one", red}, {2, "two", {}}, {3, "three", red}});
  const LabelNames given({{1, "eins", {}}, {2, "", blue}, {4, "vier", {}}});
  expect_same_names(
      file.merged_with(given),
      LabelNames({{1, "eins", red}, {2, "two", blue}, {3, "three", red}, {4, "vier", {}}}));
  expect_same_names(file.merged_with({}), file);
  expect_same_names(LabelNames().merged_with(file), file);
  expect_same_names(file.only([](RawLabel label) { return label == 3; }),
                    LabelNames({{3, "three", red}}));
}

TEST(LabelNames, ColoursThatNobodySeesAreNone) {
  EXPECT_EQ(LabelNames({{0, "Clear", Colour{}}}).find(0)->colour, std::nullopt);
  EXPECT_TRUE(LabelNames({{0, " \n", Colour{}}}).empty());
}

}  // namespace
}  // namespace mw::io
