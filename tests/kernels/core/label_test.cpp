// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Boxes of voxels and of labels: what is inside, and where.
#include "kernels/core/label.h"

#include <gtest/gtest.h>

namespace mw::test {
namespace {

TEST(Box3, OffsetsCountUpXFastest) {
  const Box3 box{{-1, 2, 5}, {3, 4, 8}};
  EXPECT_EQ(box.shape(), (Index3{4, 2, 3}));
  EXPECT_EQ(box.voxels(), 24);
  std::int64_t expected = 0;
  for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
    for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
      for (v.x = box.lo.x; v.x < box.hi.x; ++v.x) {
        EXPECT_TRUE(box.contains(v));
        EXPECT_EQ(box.offset(v), expected++);
      }
    }
  }
  for (const Index3 outside :
       {Index3{-2, 2, 5}, {3, 2, 5}, {0, 1, 5}, {0, 4, 5}, {0, 2, 4}, {0, 2, 8}}) {
    EXPECT_FALSE(box.contains(outside));
  }
}

TEST(LabelBox, FindsLabelsByVoxel) {
  LabelBox labels{{{-1, 0, 0}, {1, 2, 2}}, {0, 1, 2, 3, 4, 5, 6, kExterior}};
  EXPECT_EQ(labels.at({-1, 0, 0}), 0U);
  EXPECT_EQ(labels.at({0, 0, 0}), 1U);
  EXPECT_EQ(labels.at({-1, 1, 0}), 2U);
  EXPECT_EQ(labels.at({-1, 0, 1}), 4U);
  EXPECT_EQ(labels.at({0, 1, 1}), kExterior);
}

}  // namespace
}  // namespace mw::test
