// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The layered input: the same solid, measured in finer voxels.
#include "kernels/audit/shape/volumes.h"

#include <gtest/gtest.h>

#include "kernels/audit/audit.h"
#include "kernels/core/error.h"
#include "kernels/core/index.h"
#include "kernels/core/layers.h"
#include "tests/oracle/small_volumes.h"
#include "tests/oracle/whole_audit.h"

namespace mw::audit {
namespace {

using test::audit;
using test::below;
using test::five_tet_mesh;
using test::random_volume;
using test::SmallVolume;

TEST(LayeredLabels, RepeatEachVoxel) {
  std::mt19937 random(731);
  for (int i = 0; i < 100; ++i) {
    const SmallVolume volume = random_volume(random);
    const Index3 layers{1 + below(random, 4), 1 + below(random, 4), 1 + below(random, 4)};
    const LayeredLabels layered = layered_labels(volume.view(), layers);
    EXPECT_EQ(layered.shape, layered_shape(volume.shape, layers));
    const Box3 all{{0, 0, 0}, volume.shape};
    std::size_t next = 0;
    for_each_index(layered.shape, [&](Index3 v) {
      const Index3 voxel{v.x / layers.x, v.y / layers.y, v.z / layers.z};
      ASSERT_EQ(layered.labels[next++], volume.labels[static_cast<std::size_t>(all.offset(voxel))]);
    });
    EXPECT_EQ(layered.labels.size(), next);
  }
}

TEST(LayeredLabels, RefuseWhatIsTooLong) {
  const std::vector<Label> one{0};
  EXPECT_THROW((void)layered_labels({.shape = {1, 1, 1}, .labels = one}, {1, 1, (1 << 20) + 1}),
               Error);
}

/// A mesh that is off by one voxel of a thick slice is off by all its layers.
TEST(Promise4Distance, CountsInLayersAsAsked) {
  const SmallVolume volume =
      test::volume_from({4, 4, 4}, 2, [](auto, auto, auto z) { return z / 2; });
  const SmallVolume other =
      test::volume_from({4, 4, 4}, 2, [](auto, auto, auto z) { return z == 3 ? 1 : 0; });
  const auto mesh = five_tet_mesh(other);
  const auto farthest = [&](Index3 layers) {
    return audit(volume.view(), 2, mesh.view(), {}, {.layers = layers}).distance->max_voxels;
  };
  EXPECT_DOUBLE_EQ(farthest({1, 1, 1}), 1.0);
  EXPECT_DOUBLE_EQ(farthest({1, 1, 5}), 5.0);
  EXPECT_DOUBLE_EQ(farthest({3, 3, 1}), 1.0);
}

}  // namespace
}  // namespace mw::audit
