// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Raw labels to dense ones and back, at the ends of 64 bits and below zero.
#include "io/labels/label_table.h"
#include "io/labels/prepared_input.h"
#include "io/volume/open_volume.h"
#include "kernels/core/error.h"
#include "tests/io/labels/memory_volume.h"
#include "tests/io/volume/sample_files.h"

namespace mw::io {
namespace {

using audit::test::below;

constexpr auto kMinusOne = static_cast<RawLabel>(-1);

TEST(LabelTable, OrdersUnsignedAndSigned) {
  const LabelTable plain({kMinusOne, 3, 1ULL << 63, 3, 0}, false);
  ASSERT_EQ(plain.size(), 4U);
  EXPECT_EQ(plain.raw(0), 0U);
  EXPECT_EQ(plain.raw(2), 1ULL << 63);
  EXPECT_EQ(plain.dense(kMinusOne), 3U);
  EXPECT_FALSE(plain.contains(2));

  const LabelTable with_sign({5, kMinusOne, 0, static_cast<RawLabel>(-70000)}, true);
  EXPECT_EQ(with_sign.raw(0), static_cast<RawLabel>(-70000));
  EXPECT_EQ(with_sign.dense(kMinusOne), 1U);
  EXPECT_EQ(with_sign.dense(5), 3U);
  EXPECT_TRUE(with_sign.is_signed());

  const LabelTable narrow({5, kMinusOne}, true);
  EXPECT_EQ(narrow.dense(kMinusOne), 0U);
  EXPECT_FALSE(narrow.contains(0));
  EXPECT_FALSE(narrow.contains(6));
  EXPECT_FALSE(narrow.contains(static_cast<RawLabel>(-2)));
  EXPECT_EQ(narrow.find(static_cast<RawLabel>(-1000)), kExterior);
  EXPECT_EQ(narrow.find(1ULL << 40), kExterior);
  EXPECT_EQ(narrow.find(5), 1U);
  EXPECT_EQ(LabelTable().find(0), kExterior);
  EXPECT_FALSE(LabelTable().contains(0));
}

TEST(LabelTable, CollectsEveryLabelOfEveryType) {
  constexpr Index3 kShape{37, 41, 59};
  for (const VoxelType type : kAllTypes) {
    auto labels = sample_labels(kShape, type);
    const std::set<RawLabel> expected(labels.begin(), labels.end());
    const MemoryVolume volume(kShape, type, labels);
    const LabelTable table = collect_labels(volume);
    ASSERT_EQ(table.size(), expected.size()) << name(type);
    const DenseVolume dense(volume, table);
    const Box3 box{{3, 0, 1}, {37, 40, 57}};
    std::vector<Label> got(static_cast<std::size_t>(box.voxels()));
    std::vector<RawLabel> raw(got.size());
    dense.read(box, got);
    volume.read(box, raw);
    for (std::size_t i = 0; i < got.size(); ++i) ASSERT_EQ(table.raw(got[i]), raw[i]);
  }
}

/// Whether the table is hashed or not, and wherever the number lies.
TEST(LabelTable, RefusesALabelThatTheFirstReadingDidNotSee) {
  constexpr Index3 kShape{8, 5, 3};
  const std::vector<std::vector<RawLabel>> tables{{4, 5, 9}, {4, 5, 1ULL << 60}, {4}};
  for (const auto& values : tables) {
    const LabelTable table(values, false);
    for (const RawLabel other : std::vector<RawLabel>{0, 3, 6, 10, 1ULL << 40, kMinusOne}) {
      for (const std::size_t place : {0U, 1U, 57U, 119U}) {
        std::vector<RawLabel> labels(120, values.front());
        labels[2] = labels[100] = values.back();
        labels[place] = other;
        const MemoryVolume changed(kShape, VoxelType::kU64, labels);
        std::vector<Label> got(labels.size());
        expect_error(ErrorKind::kInput, {"changed while it was read"}, [&] {
          DenseVolume(changed, table).read({{0, 0, 0}, kShape}, got);
        });
      }
    }
  }
}

TEST(LabelTable, CollectsFromAFortranOrderFile) {
  const TempDir dir;
  const auto labels = sample_labels({50, 60, 70}, VoxelType::kU32);
  const auto path = dir.file(
      "f.npy", npy_file("<u4", true, "(70, 60, 50)", voxel_bytes(labels, VoxelType::kU32, false)));
  const std::set<RawLabel> expected(labels.begin(), labels.end());
  EXPECT_EQ(collect_labels(*open_volume(path)).size(), expected.size());
}

// Merging labels, and the order of the steps.

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
