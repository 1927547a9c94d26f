// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of a cell and its copies, voxel by voxel.
#include "engine/labels/periodic_labels.h"

#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::engine {
namespace {

using namespace mw::test;

std::int64_t floored(std::int64_t v, std::int64_t size) {
  std::int64_t copy = 0;
  for (; v < 0; v += size) --copy;
  for (; v >= size; v -= size) ++copy;
  return copy;
}

TEST(PeriodicLabels, AreThoseOfTheCellWithTheSideOfTheirCopy) {
  std::mt19937 random(881);
  for (int i = 0; i < 200; ++i) {
    const SmallVolume cell = random_volume(random);
    const std::array<bool, 3> repeats{below(random, 2) == 0, below(random, 2) == 0,
                                      below(random, 2) == 0};
    const auto any = [&] { return std::int64_t{below(random, 12)} - 6; };
    const Index3 lo{any(), any(), any()};
    const Box3 box{
        lo, lo + Index3{1 + below(random, 20), 1 + below(random, 20), 1 + below(random, 20)}};
    const Box3 all{{0, 0, 0}, cell.shape};
    if (is_empty(intersection(box, all))) continue;
    LabelBox labels = repeated_labels(box, cell.shape, repeats,
                                      [&](const Box3& in) { return labels_in(cell, in); });
    give_sides(labels, cell.shape);
    for_each_index(box, [&](Index3 v) {
      const Index3 copy{floored(v.x, cell.shape.x), floored(v.y, cell.shape.y),
                        floored(v.z, cell.shape.z)};
      const bool exists =
          (repeats[0] || copy.x == 0) && (repeats[1] || copy.y == 0) && (repeats[2] || copy.z == 0);
      ASSERT_EQ(labels.box.contains(v), exists);
      if (!exists) return;
      const Index3 voxel{v.x - copy.x * cell.shape.x, v.y - copy.y * cell.shape.y,
                         v.z - copy.z * cell.shape.z};
      const Label label = labels.at(v);
      ASSERT_EQ(without_side(label), cell.labels[static_cast<std::size_t>(all.offset(voxel))]);
      ASSERT_EQ(side_of(label), (copy.x % 2 != 0 ? side_beyond(0) : 0U) |
                                    (copy.y % 2 != 0 ? side_beyond(1) : 0U) |
                                    (copy.z % 2 != 0 ? side_beyond(2) : 0U));
    });
  }
}

}  // namespace
}  // namespace mw::engine
