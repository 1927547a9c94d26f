// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Layers against repetition voxel by voxel, in any box.
#include "io/labels/layered_volume.h"

#include "kernels/core/layers.h"
#include "tests/io/labels/memory_volume.h"

namespace mw::io {
namespace {

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
