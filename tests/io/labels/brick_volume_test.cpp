// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels in bricks against a plain array.
#include "io/labels/brick_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "kernels/core/index.h"
#include "kernels/core/label.h"
#include "tests/oracle/small_volumes.h"

namespace mw::io {
namespace {

using audit::test::below;

constexpr std::int64_t kEdge = BrickVolume::kEdge;

/// Uniform bricks and mixed ones, by turns of chance; the highest label occurs.
LabelBox random_labels(std::mt19937& random, Index3 shape, std::uint32_t labels) {
  LabelBox out{{{0, 0, 0}, shape}, std::vector<Label>(static_cast<std::size_t>(shape.product()))};
  const std::uint32_t salt = below(random, 1000);
  for_each_index(shape, [&](Index3 v) {
    const Index3 brick{v.x / kEdge, v.y / kEdge, v.z / kEdge};
    const auto number = static_cast<std::uint32_t>(brick.x + 3 * brick.y + 7 * brick.z) + salt;
    out.labels[static_cast<std::size_t>(out.box.offset(v))] =
        number % 3 == 0 ? number % labels : below(random, labels);
  });
  out.labels.back() = labels - 1;
  return out;
}

std::vector<Label> part_of(const LabelBox& all, const Box3& box) {
  std::vector<Label> out;
  for_each_index(box,
                 [&](Index3 v) { out.push_back(all.box.contains(v) ? all.at(v) : kExterior); });
  return out;
}

/// Bricks in random order.
void write_all(std::mt19937& random, const LabelBox& labels, BrickVolume& volume) {
  std::vector<Index3> bricks;
  for_each_index(volume.bricks(), [&](Index3 b) { bricks.push_back(b); });
  for (std::size_t i = bricks.size(); i > 1; --i) {
    std::swap(bricks[i - 1], bricks[below(random, static_cast<std::uint32_t>(i))]);
  }
  for (const Index3 b : bricks) volume.write(b, part_of(labels, volume.box_of(b)));
}

void expect_reads(std::mt19937& random, const LabelBox& labels, const BrickVolume& volume) {
  for (int i = 0; i < 60; ++i) {
    const auto part = [&](std::int64_t edge) {
      const std::int64_t lo =
          std::int64_t{below(random, static_cast<std::uint32_t>(edge + 30))} - 20;
      return std::pair(lo, lo + below(random, 40));
    };
    const Index3 s = volume.shape();
    const auto x = part(s.x), y = part(s.y), z = part(s.z);
    const Box3 box{{x.first, y.first, z.first}, {x.second, y.second, z.second}};
    std::vector<Label> found(static_cast<std::size_t>(box.voxels()), 77);
    volume.read(box, found);
    ASSERT_EQ(found, part_of(labels, box));
  }
}

void expect_uniform_labels(const LabelBox& labels, const BrickVolume& volume, int& uniform) {
  for_each_index(volume.bricks(), [&](Index3 b) {
    const std::vector<Label> voxels = part_of(labels, volume.box_of(b));
    const bool same = std::count(voxels.begin(), voxels.end(), voxels[0]) == std::ssize(voxels);
    EXPECT_EQ(volume.uniform_label(b), same ? std::optional(voxels[0]) : std::nullopt);
    uniform += same ? 1 : 0;
  });
}

/// Numbers of labels at which the stored type changes, and odd shapes.
TEST(BrickVolume, ReadsWhatAnArrayWould) {
  std::mt19937 random(1061);
  constexpr std::array<std::uint32_t, 7> kLabels{1, 2, 256, 257, 65536, 65537, 0xfffffff0U};
  constexpr std::array<Index3, 5> kShapes{
      {{1, 1, 1}, {16, 16, 16}, {17, 40, 5}, {50, 33, 31}, {3, 2, 70}}};
  int uniform = 0, bricks = 0;
  for (const std::uint32_t count : kLabels) {
    for (const Index3 shape : kShapes) {
      const LabelBox labels = random_labels(random, shape, count);
      BrickVolume volume(shape, count, scratch_folder());
      EXPECT_EQ(volume.shape(), shape);
      write_all(random, labels, volume);
      expect_reads(random, labels, volume);
      expect_uniform_labels(labels, volume, uniform);
      bricks += static_cast<int>(volume.bricks().product());
    }
  }
  EXPECT_GT(uniform, bricks / 5);
  EXPECT_LT(uniform, bricks * 4 / 5);
}

TEST(BrickVolume, CutsTheVolumeIntoItsBricks) {
  const BrickVolume volume({35, 16, 1}, 2, scratch_folder());
  EXPECT_EQ(volume.bricks(), (Index3{3, 1, 1}));
  EXPECT_EQ(volume.box_of({0, 0, 0}), (Box3{{0, 0, 0}, {16, 16, 1}}));
  EXPECT_EQ(volume.box_of({2, 0, 0}), (Box3{{32, 0, 0}, {35, 16, 1}}));
}

}  // namespace
}  // namespace mw::io
