// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One table of settings: none is left out, and each is named, read, refused and told apart.
#include <gmock/gmock.h>
#include <cctype>

#include "engine/settings/number_text.h"
#include "engine/settings/setting_table.h"
#include "engine/store/journal/identity.h"
#include "kernels/core/error.h"
#include "tests/engine/settings/setting_samples.h"

namespace mw::engine {
namespace {

using test::samples;
using testing::HasSubstr;

MeshSettings with(const Setting& setting, const std::string& text) {
  MeshSettings settings;
  set(setting, settings, text);
  return settings;
}

std::string message_of(const Setting& setting, const std::string& text) {
  try {
    (void)with(setting, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    return error.what();
  }
  ADD_FAILURE() << setting.name << " took " << text;
  return {};
}

std::string identity(const MeshSettings& settings) {
  return identity_text(io::VolumeInfo{}, settings);
}

/// Is taken for a value of any type.
struct Anything {
  template <class T>
  operator T() const {  // NOLINT(google-explicit-constructor)
    return T();
  }
};

/// Returns the number of fields of an aggregate.
template <class T, class... Fields>
constexpr std::size_t fields() {
  if constexpr (requires { T{Fields{}..., Anything{}}; }) {
    return fields<T, Fields..., Anything>();
  } else {
    return sizeof...(Fields);
  }
}

/// Entries change one value each, as EveryValueHasItsIdentity shows, so as many entries as fields
/// leave out none.
TEST(SettingTable, LeavesOutNoField) {
  EXPECT_EQ(setting_table().size(), fields<MeshSettings>() - 1 + fields<SizeSettings>());
}

TEST(SettingTable, NamesAreUnlikeAndPlain) {
  std::set<std::string> names;
  for (const Setting& setting : setting_table()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    for (const char c : setting.name) EXPECT_TRUE(std::islower(c) != 0 || c == '-');
    EXPECT_FALSE(setting.help.empty());
    EXPECT_EQ(setting.choices.empty(), setting.kind != ValueKind::kText);
  }
}

TEST(SettingTable, DefaultsAreAllowed) {
  EXPECT_NO_THROW(check(MeshSettings{}));
  for (const Setting& setting : setting_table()) EXPECT_NO_THROW(check(setting, {}));
}

/// Text to settings to text; and the default's text is taken as well.
TEST(SettingTable, TextsSurviveTheWayThere) {
  for (const Setting& setting : setting_table()) {
    std::vector<std::string> texts = samples(setting).good;
    texts.push_back(setting.text(MeshSettings{}));
    for (const std::string& text : texts) {
      EXPECT_EQ(setting.text(with(setting, text)), text) << setting.name;
    }
  }
}

TEST(SettingTable, EveryChoiceCanBeMade) {
  for (const Setting& setting : setting_table()) {
    for (const std::string& choice : setting.choices) {
      EXPECT_EQ(setting.text(with(setting, choice)), choice) << setting.name;
    }
  }
}

/// An entry changes its own field alone, and every other value is another run.
TEST(SettingTable, EveryValueHasItsIdentity) {
  const MeshSettings defaults;
  std::set<std::string> identities{identity(defaults)};
  for (const Setting& setting : setting_table()) {
    for (const std::string& text : samples(setting).good) {
      const MeshSettings settings = with(setting, text);
      EXPECT_TRUE(identities.insert(identity(settings)).second) << setting.name << " = " << text;
      EXPECT_THAT(identity(settings), HasSubstr("\n" + setting.name + " = " + text + "\n"));
      for (const Setting& other : setting_table()) {
        if (other.name == setting.name) continue;
        EXPECT_EQ(other.text(settings), other.text(defaults)) << setting.name << " " << other.name;
      }
    }
  }
}

TEST(SettingTable, OutOfRangeIsRefusedWithWhatIsAllowed) {
  for (const Setting& setting : setting_table()) {
    EXPECT_EQ(samples(setting).outside.empty(), setting.is_allowed == nullptr || setting.has_labels)
        << setting.name;
    for (const std::string& text : samples(setting).outside) {
      EXPECT_EQ(message_of(setting, text), "must be " + setting.allowed) << setting.name << text;
    }
  }
}

TEST(SettingTable, WhatIsNoValueIsRefused) {
  for (const Setting& setting : setting_table()) {
    for (const std::string& text : samples(setting).bad) {
      EXPECT_FALSE(message_of(setting, text).empty()) << setting.name << " = " << text;
    }
  }
}

/// Settings of a program, which no text has been.
TEST(SettingTable, CheckNamesSettingValueAndWhatIsAllowed) {
  const auto refusal = [](const MeshSettings& settings) -> std::string {
    try {
      check(settings);
      return "allowed";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal({.window = 41}), "window = 41: must be an even number from 4 to 256");
  EXPECT_EQ(refusal({.quality_floor = 0.75}), "quality-floor = 0.75: must be from 0 to 0.5");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double size : {0.0, -1.0, kInfinity, kNan}) {
    EXPECT_THAT(refusal({.sizes = {.rules = {.labels = {{3, size}}}}}),
                HasSubstr("must be positive"));
    EXPECT_THAT(refusal({.sizes = {.rules = {.others = size}}}), HasSubstr("positive"));
    EXPECT_THAT(refusal({.sizes = {.rules = {.interfaces = {{3, 4, size}}}}}),
                HasSubstr("positive"));
  }
  EXPECT_THAT(refusal({.sizes = {.rules = {.labels = {{2, 1.0}, {2, 2.0}}}}}), HasSubstr("once"));
  EXPECT_THAT(refusal({.sizes = {.rules = {.labels = {{3, 1.0}, {2, 1.0}}}}}),
              HasSubstr("ascending"));
  EXPECT_EQ(refusal({.sizes = {.rules = {.labels = {{2, 1.0}, {3, 1.0}}}}}), "allowed");
  EXPECT_THAT(refusal({.sizes = {.gradation = kNan}}), HasSubstr("gradation = nan: "));
  EXPECT_THAT(refusal({.sizes = {.gradation = 0.2}}), HasSubstr("nothing to grade"));
  EXPECT_EQ(refusal({.sizes = {.rules = {.others = 3.0}, .gradation = 0.2}}), "allowed");
  EXPECT_THAT(refusal({.optimizer = Optimizer::kTetgen, .sizes = {.inner_vertices = true}}),
              HasSubstr("keeps no sizes"));
}

TEST(SettingTable, SizesAreSortedByLabel) {
  const auto& table = setting_table();
  const auto size =
      std::find_if(table.begin(), table.end(), [](const Setting& s) { return s.has_labels; });
  ASSERT_NE(size, table.end());
  EXPECT_EQ(size->text(with(*size, "7=4,1=2.5")), "1=2.5,7=4");
  EXPECT_EQ(size->text(with(*size, "-1=4")), "18446744073709551615=4");
  EXPECT_EQ(size->text(with(*size, "4,5|3=2,2=1,@f.nii.gz")), "2=1,3|5=2,*=4,@f.nii.gz");
  EXPECT_EQ(size->text(with(*size, "d/f.npy")), "@d/f.npy");
  EXPECT_THAT(message_of(*size, "3=1,2=1,3=1"), HasSubstr("label 3 has two sizes"));
  EXPECT_THAT(message_of(*size, "3|1=1,1|3=1"), HasSubstr("1|3 has two sizes"));
  EXPECT_THAT(message_of(*size, "3,*=1"), HasSubstr("* has two sizes"));
}

// Memory and labels as people write them.

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

TEST(ParseCacheFolder, WhatIsBehindTheLastCommaIsASize) {
  EXPECT_EQ(parse_cache_folder("a").path, "a");
  EXPECT_EQ(parse_cache_folder("a,4K").path, "a");
  EXPECT_EQ(parse_cache_folder("a,4K").bytes, 4096U);
  EXPECT_EQ(parse_cache_folder("a,b,4K").path, "a,b");
  for (const char* text : {"a,abc", "a,", "a,b", "a,10GX", ",4K", ""}) {
    EXPECT_THROW(static_cast<void>(parse_cache_folder(text)), Error) << text;
  }
}

}  // namespace
}  // namespace mw::engine
