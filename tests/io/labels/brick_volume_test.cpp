// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels in bricks against a plain array.
#include "io/labels/brick_volume.h"
#include "io/labels/repeated_volume.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"
#include "kernels/core/lattice.h"
#include "tests/io/labels/memory_volume.h"
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

// Layers against repetition voxel by voxel, in any box.

std::vector<RawLabel> random_labels(std::mt19937& random, Index3 shape) {
  std::vector<RawLabel> labels(static_cast<std::size_t>(shape.product()));
  for (RawLabel& label : labels) label = random();
  return labels;
}

/// A volume that knows how much was read of it.
class CountingVolume : public MemoryVolume {
 public:
  CountingVolume(Index3 shape, std::mt19937& random)
      : MemoryVolume(shape, VoxelType::kU64, random_labels(random, shape)) {
    info().space = {.spacing = {0.5, 3, 1.25}, .origin = {-1, 2, 0.25}};
  }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    MemoryVolume::read(box, out);
    voxels_read += box.voxels();
  }

  mutable std::int64_t voxels_read = 0;
};

std::int64_t one_to(std::mt19937& random, std::int64_t max) {
  return 1 + static_cast<std::int64_t>(random() % static_cast<unsigned>(max));
}

TEST(LayeredVolume, RepeatsEachVoxelInEveryBox) {
  std::mt19937 random(712);
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    const CountingVolume volume({one_to(random, 5), one_to(random, 5), one_to(random, 5)}, random);
    const Index3 layers{one_to(random, 4), one_to(random, 4), one_to(random, 4)};
    const LayeredVolume layered(volume, layers);
    const Index3 shape = layered_shape(volume.info().shape, layers);
    ASSERT_EQ(layered.info().shape, shape);
    const Box3 box = i % 10 == 0 ? Box3{{0, 0, 0}, shape} : random_box(random, shape);
    std::vector<RawLabel> got(static_cast<std::size_t>(box.voxels()));
    layered.read(box, got);
    std::size_t next = 0;
    for_each_index(box, [&](Index3 v) {
      EXPECT_EQ(got[next++], volume.at({v.x / layers.x, v.y / layers.y, v.z / layers.z}));
    });
    EXPECT_LE(volume.voxels_read, volume.info().shape.product()) << "a voxel was read twice";
  }
}

TEST(LayeredVolume, KeepsTheFactsOfTheVolume) {
  std::mt19937 random(713);
  const CountingVolume volume({4, 5, 6}, random);
  const LayeredVolume layered(volume, {1, 6, 5});
  EXPECT_EQ(layered.info().shape, (Index3{4, 30, 30}));
  EXPECT_EQ(layered.info().space.spacing, (std::array{0.5, 0.5, 0.25}));
  EXPECT_EQ(layered.info().space.origin, volume.info().space.origin);
  EXPECT_EQ(layered.info().type, volume.info().type);
}

}  // namespace
}  // namespace mw::io
