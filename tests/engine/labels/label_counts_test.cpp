// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What parts count adds up to what the whole counts.
#include "engine/labels/label_counts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/labels/prepared_labels.h"
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

using audit::test::below;

TEST(LabelCounts, OfPartsAddUpToThoseOfTheWhole) {
  std::mt19937 random(61);
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Index3 shape{1 + below(random, 80), 1 + below(random, 60), 1 + below(random, 90)};
    const auto kind = static_cast<audit::test::VolumeKind>(i % audit::test::kVolumeKinds);
    const auto small = audit::test::random_volume_of(random, kind, shape, 1 + below(random, 5));
    const test::MemoryVolume memory(small, {});
    const io::LabelTable table = io::collect_labels(memory);
    const io::DenseVolume volume(memory, table);
    const PreparedLabels whole(volume, {.start = StartMesh::kDense});
    const int parts = 1 + static_cast<int>(below(random, 6));
    LabelCounts sum(shape, table.size());
    for (int part = 0; part < parts; ++part) {
      const LabelCounts more = counts_of_part(volume, 1 + part % 3, {part, parts});
      sum.faces.add(0, more.faces.counts());
      for (std::size_t l = 0; l < table.size(); ++l) sum.voxels[l] += more.voxels[l];
    }
    EXPECT_EQ(sum.voxels, whole.counts().voxels);
    EXPECT_TRUE(std::ranges::equal(sum.faces.counts(), whole.counts().faces.counts()));
  }
}

}  // namespace
}  // namespace mw::engine
