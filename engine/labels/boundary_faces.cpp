// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts the faces between voxels of different labels, brick by brick.
#include "engine/labels/boundary_faces.h"

#include <algorithm>

#include "engine/labels/bricks.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

static_assert(3 * kBrick * kBrick * kBrick <= 0xffff);

std::int64_t bricks_along(std::int64_t voxels) {
  return (voxels + kBrick - 1) / kBrick;
}

/// Counts the faces between `count` voxels of a row and those above them in y and z, and between
/// `next` of them and the next in x.  up and out are steps to the voxel above in y and z, or 0.
std::uint32_t faces_of_row(const Label* row, std::int64_t count, std::int64_t next, std::int64_t up,
                           std::int64_t out) {
  std::uint32_t faces = 0;
  for (std::int64_t x = 0; x < count; ++x) {
    faces += (row[x] != row[x + up] ? 1U : 0U) + (row[x] != row[x + out] ? 1U : 0U);
  }
  for (std::int64_t x = 0; x < next; ++x) faces += row[x] != row[x + 1] ? 1U : 0U;
  return faces;
}

}  // namespace

BoundaryFaces::BoundaryFaces(Index3 volume)
    : volume_(volume),
      bricks_{bricks_along(volume.x), bricks_along(volume.y), bricks_along(volume.z)},
      faces_(static_cast<std::size_t>(bricks_.product())) {}

void BoundaryFaces::count(const LabelBox& labels, Index3 brick, bool uniform) {
  const Box3 box = box_of(brick);
  const Index3 all = labels.box.shape(), last = box.hi - Index3{1, 1, 1};
  const bool more_x = box.hi.x < labels.box.hi.x;
  std::uint32_t faces = 0;
  for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
    for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
      const bool inner = uniform && v.y != last.y && v.z != last.z;
      v.x = inner ? last.x : box.lo.x;
      const std::int64_t count = box.hi.x - v.x;
      faces += faces_of_row(labels.labels.data() + labels.box.offset(v), count,
                            more_x ? count : count - 1, v.y + 1 < labels.box.hi.y ? all.x : 0,
                            v.z + 1 < labels.box.hi.z ? all.x * all.y : 0);
    }
  }
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
