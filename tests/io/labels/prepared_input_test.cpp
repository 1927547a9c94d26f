// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Merging labels, and the order of the steps.
#include "io/labels/prepared_input.h"

#include <map>

#include "tests/io/labels/memory_volume.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

using audit::test::below;

const std::vector<RawLabel> kRaw{0, 5, RawLabel{1} << 50U, 6};
constexpr RawLabel kMinusTwo = ~RawLabel{1};

TEST(MergedVolume, ChangesEveryLabelAtOnce) {
  std::mt19937 random(3);
  for (int i = 0; i < 500 && !testing::Test::HasFailure(); ++i) {
    const auto small = audit::test::random_volume_of(
        random, static_cast<audit::test::VolumeKind>(i % 8), {7, 6, 5}, 4);
    const MemoryVolume volume = volume_of(small, VoxelType::kU64, kRaw);
    std::map<RawLabel, RawLabel> becomes;
    std::vector<MergeRule> rules;
    for (const RawLabel label : kRaw) {
      const auto& all = volume.labels();
      if (below(random, 3) == 0 || std::find(all.begin(), all.end(), label) == all.end()) continue;
      const RawLabel to = below(random, 2) == 0 ? kRaw[below(random, 4)] : 1000 + below(random, 2);
      becomes[label] = to;
      rules.push_back({{label}, to});
    }
    std::vector<RawLabel> wanted = volume.labels();
    for (RawLabel& label : wanted) label = becomes.contains(label) ? becomes[label] : label;
    const MergedVolume merged(volume, rules);
    EXPECT_EQ(read_all(merged), wanted);
    expect_box(merged, wanted, random);
  }
}

TEST(MergedVolume, RefusesWhatCannotBe) {
  const MemoryVolume plain({2, 2, 1}, VoxelType::kU8, {0, 5, 6, 5});
  const MemoryVolume with_signs({2, 1, 1}, VoxelType::kI16, {kMinusTwo, 5});
  const auto expect_refused = [](const MemoryVolume& volume, const std::vector<MergeRule>& rules,
                                 const std::string& piece) {
    expect_error(ErrorKind::kUsage, {"--merge", piece}, [&] { MergedVolume(volume, rules); });
  };
  expect_refused(plain, {{{5, 9}, 1}}, "no label 9");
  expect_refused(with_signs, {{{kMinusTwo - 1}, 1}}, "no label -3");
  expect_refused(plain, {{{5}, 1}, {{6, 5}, 2}}, "label 5 is to be merged twice");
  expect_refused(with_signs, {{{kMinusTwo, kMinusTwo}, 1}}, "label -2 is to be merged twice");
  expect_refused(plain, {{{5}, kMinusTwo, true}}, "-2: labels of the volume are not negative");
  expect_refused(with_signs, {{{5}, kMinusTwo, false}}, "18446744073709551614: labels");
  EXPECT_EQ(read_all(MergedVolume(with_signs, {{{5}, kMinusTwo, true}})),
            (std::vector<RawLabel>{kMinusTwo, kMinusTwo}));
  EXPECT_EQ(read_all(MergedVolume(plain, {{{5}, 6}, {{6}, 5}})),
            (std::vector<RawLabel>{0, 6, 5, 6}));
}

/// Two labels of which neither is too small once they are one.
TEST(PreparedInput, MergesBeforeItDropsSpecks) {
  const MemoryVolume volume({6, 1, 1}, VoxelType::kU8, {1, 1, 1, 2, 3, 3});
  const InputSteps steps{.merge = {{{2, 3}, 4}}, .specks = SpeckRule{3, false}};
  const PreparedInput input(volume, steps);
  EXPECT_EQ(read_all(input.volume()), (std::vector<RawLabel>{1, 1, 1, 4, 4, 4}));
  ASSERT_TRUE(input.specks().has_value());
  EXPECT_EQ(input.specks()->components, 0U);
  const PreparedInput apart(volume, {.merge = {}, .specks = SpeckRule{3, false}});
  EXPECT_EQ(read_all(apart.volume()), (std::vector<RawLabel>{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(apart.specks()->rounds, 2);
  EXPECT_EQ(&PreparedInput(volume, {}).volume(), &volume);
  EXPECT_FALSE(PreparedInput(volume, {}).specks().has_value());
}

}  // namespace
}  // namespace mw::io
