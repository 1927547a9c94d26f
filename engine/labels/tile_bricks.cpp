// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bricks cut out of larger boxes of labels.
#include "engine/labels/tile_bricks.h"

#include "kernels/core/index.h"

namespace mw::engine {

constexpr std::int64_t kBrick = io::BrickVolume::kEdge;

Box3 bricks_over(const Box3& voxels) {
  const auto after = [](std::int64_t voxel) { return (voxel + kBrick - 1) / kBrick; };
  return {{voxels.lo.x / kBrick, voxels.lo.y / kBrick, voxels.lo.z / kBrick},
          {after(voxels.hi.x), after(voxels.hi.y), after(voxels.hi.z)}};
}

void cut_brick(const LabelBox& from, const Box3& brick, std::vector<Label>& out) {
  out.clear();
  for (Index3 v = brick.lo; v.z < brick.hi.z; ++v.z) {
    for (v.y = brick.lo.y; v.y < brick.hi.y; ++v.y) {
      const auto row = from.labels.begin() + from.box.offset({brick.lo.x, v.y, v.z});
      out.insert(out.end(), row, row + brick.shape().x);
    }
  }
}

LabelBox read_labels(const io::DenseVolume& volume, const Box3& box) {
  LabelBox out{box, std::vector<Label>(static_cast<std::size_t>(box.voxels()))};
  volume.read(box, out.labels);
  return out;
}

void for_each_brick(const LabelBox& tile, const OnBrick& visit) {
  std::vector<Label> one;
  for_each_index(bricks_over(tile.box), [&](Index3 brick) {
    const Index3 lo{brick.x * kBrick, brick.y * kBrick, brick.z * kBrick};
    const Box3 box = intersection({lo, lo + Index3{kBrick, kBrick, kBrick}}, tile.box);
    cut_brick(tile, box, one);
    visit(brick, box, one);
  });
}

}  // namespace mw::engine
