// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts that stand for a volume: where they lie, how much they are, and that what they hold, times
// what they stand for, is what the volume holds.
#include "engine/job/pilot_sample.h"

#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

using audit::test::SmallVolume;

constexpr std::int64_t kLarge = std::int64_t{1} << 23;

/// Labels in slabs and columns, whose mixture is the same all over the volume.
SmallVolume grid_of(Index3 shape) {
  return audit::test::volume_from(
      shape, 3, [](auto x, auto y, auto z) { return (x / 5 + y / 5 + z / 7) % 3; });
}

struct Sampled {
  BoxContent content;
  std::vector<PilotPart> parts;
};

Sampled sampled(const SmallVolume& volume, std::int64_t max_cut) {
  const test::MemoryVolume memory(volume, {});
  const io::LabelTable table = io::collect_labels(memory);
  const VoxelLattice lattice(io::DenseVolume(memory, table));
  const PreparedLabels labels(lattice.labels(), {.start = StartMesh::kDense}, 1);
  const LabelSelection all({}, table);
  const PilotSample sample(lattice, labels, all, max_cut);
  return {sample.content(), sample.parts(0.5)};
}

TEST(PilotSample, HasNoPartsOfASmallVolume) {
  for (const Index3 shape : {Index3{48, 48, 48}, Index3{27, 130, 30}, Index3{1, 1, 100}}) {
    EXPECT_TRUE(sampled(grid_of(shape), kLarge).parts.empty()) << shape.x << " " << shape.y;
  }
}

TEST(PilotSample, IsAFewPartsOfALargerOne) {
  for (const Index3 shape : {Index3{64, 64, 64}, Index3{64, 60, 58}, Index3{30, 100, 120}}) {
    SCOPED_TRACE(shape.x);
    const Sampled one = sampled(grid_of(shape), kLarge);
    ASSERT_EQ(one.parts.size(), 1U);
    const PilotPart& part = one.parts.front();
    EXPECT_EQ(intersection(part.voxels, {{0, 0, 0}, shape}), part.voxels);
    EXPECT_LE(part.voxels.voxels(), shape.product() / 6);
    const Box3 mine{{0, 0, 0}, part.voxels.shape()};
    EXPECT_EQ(intersection(part.within, mine), part.within);
    EXPECT_EQ(one.content.voxels, shape.product());
    // All is alike, so a part stands for the whole by its share, except for what cuts add.
    const double share = static_cast<double>(part.within.voxels()) * part.weight;
    EXPECT_NEAR(share / static_cast<double>(shape.product()), 1.0, 0.1);
  }
}

TEST(PilotSample, DrawsPartsOfALargeOne) {
  const Index3 shape{170, 165, 160};
  const Sampled some = sampled(grid_of(shape), 1);
  double share = 0;
  std::int64_t meshed = 0;
  for (const PilotPart& part : some.parts) {
    EXPECT_EQ(intersection(part.voxels, {{0, 0, 0}, shape}), part.voxels);
    share += static_cast<double>(part.within.voxels()) * part.weight;
    meshed += part.voxels.voxels();
  }
  EXPECT_EQ(some.parts.size(), 2U);
  EXPECT_LE(meshed, shape.product() * 3 / 10);
  EXPECT_NEAR(share / static_cast<double>(shape.product()), 1.0, 0.1);
}

}  // namespace
}  // namespace mw::engine
