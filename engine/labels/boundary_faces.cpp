// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Faces between labels, counted brick by brick.
#include "engine/labels/label_counts.h"

#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

static_assert(3 * kBrick * kBrick * kBrick <= 0xffff);

std::int64_t bricks_along(std::int64_t voxels) {
  return (voxels + kBrick - 1) / kBrick;
}

/// Counts the faces between a voxel of an array of this shape and those above it along each axis.
std::uint32_t faces_above(const Label* voxel, Index3 at, Index3 shape) {
  const Label label = *voxel;
  return (at.x + 1 < shape.x && voxel[1] != label ? 1U : 0U) +
         (at.y + 1 < shape.y && voxel[shape.x] != label ? 1U : 0U) +
         (at.z + 1 < shape.z && voxel[shape.x * shape.y] != label ? 1U : 0U);
}

}  // namespace

BoundaryFaces::BoundaryFaces(Index3 volume)
    : volume_(volume),
      bricks_{bricks_along(volume.x), bricks_along(volume.y), bricks_along(volume.z)},
      faces_(static_cast<std::size_t>(bricks_.product())) {}

void BoundaryFaces::count(Index3 brick, std::span<const Label> voxels) {
  const Index3 shape = box_of(brick).shape();
  MW_ASSERT(static_cast<std::int64_t>(voxels.size()) == shape.product());
  std::uint32_t faces = 0;
  const Label* voxel = voxels.data();
  for_each_index(shape, [&](Index3 at) { faces += faces_above(voxel++, at, shape); });
  faces_[row(brick)] = static_cast<std::uint16_t>(faces);
}

void BoundaryFaces::add(std::size_t first, std::span<const std::uint16_t> counts) {
  for (const std::uint16_t more : counts) {
    faces_[first] = static_cast<std::uint16_t>(faces_[first] + more);
    ++first;
  }
}

double BoundaryFaces::in(const Box3& box) const {
  const auto below = [](std::int64_t voxel) { return voxel / kBrick; };
  const Box3 inside = intersection(box, {{0, 0, 0}, volume_});
  if (is_empty(inside)) return 0;
  const Box3 touched{
      {below(inside.lo.x), below(inside.lo.y), below(inside.lo.z)},
      {bricks_along(inside.hi.x), bricks_along(inside.hi.y), bricks_along(inside.hi.z)}};
  double faces = 0;
  for_each_index(touched, [&](Index3 brick) {
    const Box3 whole = box_of(brick);
    const auto part = static_cast<double>(intersection(whole, inside).voxels());
    faces += faces_[row(brick)] * part / static_cast<double>(whole.voxels());
  });
  return faces;
}

Box3 BoundaryFaces::box_of(Index3 brick) const {
  const Index3 lo{brick.x * kBrick, brick.y * kBrick, brick.z * kBrick};
  return intersection({lo, lo + Index3{kBrick, kBrick, kBrick}}, {{0, 0, 0}, volume_});
}

}  // namespace mw::engine
