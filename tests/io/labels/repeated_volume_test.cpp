// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of a cell's copies are those of the cell.
#include "io/labels/repeated_volume.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/io/labels/memory_volume.h"
#include "tests/oracle/small_volumes.h"

namespace mw::io {
namespace {

using audit::test::below;

std::int64_t wrapped(std::int64_t at, std::int64_t voxels) {
  return (at % voxels + voxels) % voxels;
}

TEST(PeriodicVolume, RepeatsTheCell) {
  std::mt19937 random(711);
  for (int i = 0; i < 60; ++i) {
    const auto draw = [&](std::uint32_t most) { return std::int64_t{below(random, most)}; };
    const Index3 shape{1 + draw(7), 1 + draw(7), 1 + draw(7)}, margin{draw(20), draw(3), draw(9)};
    std::vector<RawLabel> labels(static_cast<std::size_t>(shape.product()));
    for (RawLabel& label : labels) label = below(random, 5);
    const Box3 cell{{0, 0, 0}, shape};
    const MemoryVolume memory(shape, VoxelType::kU8, labels);
    const PeriodicVolume volume(memory, margin);
    EXPECT_EQ(volume.info().shape, shape + margin + margin);
    const Box3 box = random_box(random, volume.info().shape);
    std::vector<RawLabel> read(static_cast<std::size_t>(box.voxels()));
    volume.read(box, read);
    std::size_t next = 0;
    for_each_index(box, [&](Index3 v) {
      const Index3 at = v - margin;
      const Index3 inside{wrapped(at.x, shape.x), wrapped(at.y, shape.y), wrapped(at.z, shape.z)};
      EXPECT_EQ(read[next++], labels[static_cast<std::size_t>(cell.offset(inside))]);
    });
  }
}

}  // namespace
}  // namespace mw::io
