// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/labels/periodic_labels.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "kernels/core/face_sample.h"

namespace mw::engine {
namespace {

/// A cell of 16 voxels behind a face depends on cells of 8 in the cubes of 16 around it, and these
/// depend on labels up to 6 voxels around them.
constexpr std::int64_t kMargin = 48;

bool is_periodic(const MeshSettings& settings, unsigned axis) {
  return (settings.periodic >> axis & 1U) != 0;
}

std::int64_t floor_div(std::int64_t v, std::int64_t size) {
  return (v < 0 ? v - size + 1 : v) / size;
}

/// Returns the number of a corner in a volume (VertexId) from that in the volume with its margin.
VertexId id_within(VertexId id, Index3 volume, Index3 margin) {
  const Index3 one{1, 1, 1};
  const Index3 corner = index_at(id, volume + margin + margin + one) - margin;
  return raster(corner, volume + one);
}

}  // namespace

Index3 periodic_margin(const MeshSettings& settings) {
  const auto margin = [&](unsigned axis) { return is_periodic(settings, axis) ? kMargin : 0; };
  return {margin(0), margin(1), margin(2)};
}

int periodic_level(Index3 shape, const MeshSettings& settings, int level) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (!is_periodic(settings, axis)) continue;
    while (level > 0 && along(shape, axis) % (std::int64_t{2} << level) != 0) --level;
  }
  return level;
}

BoxPlanes inner_planes(const MeshSettings& settings) {
  unsigned planes = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (is_periodic(settings, axis)) planes |= 3U << 2 * axis;
  }
  return static_cast<BoxPlanes>(planes);
}

int largest_window(Index3 shape, const MeshSettings& settings) {
  std::int64_t most = std::numeric_limits<int>::max();
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (is_periodic(settings, axis)) most = std::min(most, (along(shape, axis) - 1) / 2 * 2);
  }
  return static_cast<int>(std::max<std::int64_t>(most, 2));
}

void give_sides(LabelBox& labels, Index3 cell) {
  const auto sides = [](std::int64_t lo, std::int64_t hi, std::int64_t size, unsigned axis) {
    std::vector<Label> out;
    for (std::int64_t v = lo; v < hi; ++v) {
      out.push_back(floor_div(v, size) % 2 != 0 ? side_beyond(axis) : 0U);
    }
    return out;
  };
  const Box3& box = labels.box;
  const std::vector<Label> of_x = sides(box.lo.x, box.hi.x, cell.x, 0),
                           of_y = sides(box.lo.y, box.hi.y, cell.y, 1),
                           of_z = sides(box.lo.z, box.hi.z, cell.z, 2);
  auto label = labels.labels.begin();
  for (const Label z : of_z) {
    for (const Label y : of_y) {
      for (const Label x : of_x) *label++ |= x | y | z;
    }
  }
}

void each_copy(const Box3& box, Index3 cell, std::array<bool, 3> repeats,
               const std::function<void(const Box3& part, Index3 by)>& visit) {
  const auto first = [&](std::int64_t lo, std::int64_t size, std::size_t axis) {
    return repeats[axis] ? floor_div(lo, size) : 0;
  };
  const auto end = [&](std::int64_t hi, std::int64_t size, std::size_t axis) {
    return repeats[axis] ? floor_div(hi - 1, size) + 1 : 1;
  };
  const Box3 copies{
      {first(box.lo.x, cell.x, 0), first(box.lo.y, cell.y, 1), first(box.lo.z, cell.z, 2)},
      {end(box.hi.x, cell.x, 0), end(box.hi.y, cell.y, 1), end(box.hi.z, cell.z, 2)}};
  for_each_index(copies, [&](Index3 i) {
    const Index3 by{i.x * cell.x, i.y * cell.y, i.z * cell.z};
    const Box3 part = intersection(box, {by, by + cell});
    if (!is_empty(part)) visit(part, by);
  });
}

LabelBox repeated_labels(const Box3& box, Index3 cell, std::array<bool, 3> repeats,
                         const std::function<LabelBox(const Box3&)>& labels_of) {
  Box3 inside = box;
  const Box3 all = intersection(box, {{0, 0, 0}, cell});
  if (!repeats[0]) inside.lo.x = all.lo.x, inside.hi.x = all.hi.x;
  if (!repeats[1]) inside.lo.y = all.lo.y, inside.hi.y = all.hi.y;
  if (!repeats[2]) inside.lo.z = all.lo.z, inside.hi.z = all.hi.z;
  if (inside == all) return labels_of(inside);
  LabelBox out{inside, std::vector<Label>(static_cast<std::size_t>(inside.voxels()))};
  each_copy(inside, cell, repeats, [&](const Box3& part, Index3 by) {
    const LabelBox labels = labels_of({part.lo - by, part.hi - by});
    copy_box<Label>(part, part, labels.labels, inside, out.labels);
  });
  return out;
}

BlockMesh without_margin(BlockMesh mesh, Index3 volume, Index3 margin) {
  if (margin == Index3{}) return mesh;
  for (BlockVertex& v : mesh.vertices) {
    v.id = id_within(v.id, volume, margin);
    v.position = moved(v.position, Index3{} - margin);
  }
  const Box3 inside{{0, 0, 0}, volume};
  std::vector<BlockSample> samples;
  for (BlockSample s : mesh.samples) {
    const Index3 lower = lower_voxel(s.samples) - margin;
    const unsigned axis = axis_of(s.samples);
    if (!inside.contains(lower) || !inside.contains(lower + axis_vector(axis))) continue;
    s.samples = face_samples(lower, axis, quarters_of(s.samples));
    samples.push_back(s);
  }
  std::sort(samples.begin(), samples.end());
  mesh.samples = std::move(samples);
  return mesh;
}

}  // namespace mw::engine
