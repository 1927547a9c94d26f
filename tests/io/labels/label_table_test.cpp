// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Raw labels to dense ones and back, at the ends of 64 bits and below zero.
#include "io/labels/label_table.h"

#include <set>

#include "io/volume/open_volume.h"
#include "kernels/core/error.h"
#include "tests/io/volume/sample_files.h"

namespace mw::io {
namespace {

/// A volume in memory.
class MemoryVolume : public LabelVolume {
 public:
  MemoryVolume(Index3 shape, VoxelType type, std::vector<RawLabel> labels)
      : info_{.shape = shape, .type = type, .format = "memory"}, labels_(std::move(labels)) {}
  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    const Box3 all{{0, 0, 0}, info_.shape};
    for (std::int64_t z = box.lo.z; z < box.hi.z; ++z) {
      for (std::int64_t y = box.lo.y; y < box.hi.y; ++y) {
        for (std::int64_t x = box.lo.x; x < box.hi.x; ++x) {
          out[static_cast<std::size_t>(box.offset({x, y, z}))] =
              labels_[static_cast<std::size_t>(all.offset({x, y, z}))];
        }
      }
    }
  }

 private:
  VolumeInfo info_;
  std::vector<RawLabel> labels_;
};

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
        try {
          DenseVolume(changed, table).read({{0, 0, 0}, kShape}, got);
          ADD_FAILURE() << other << " at " << place;
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::kInput);
          EXPECT_NE(std::string(error.what()).find("changed while it was read"), std::string::npos);
        }
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

}  // namespace
}  // namespace mw::io
