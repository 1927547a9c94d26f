// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/labels/periodic_labels.h"

#include <algorithm>
#include <string_view>

#include "io/file/errors.h"
#include "kernels/core/face_sample.h"

namespace mw::engine {
namespace {

/// A cell of 16 voxels behind a face depends on cells of 8 in the cubes of 16 around it, and these
/// depend on labels up to 6 voxels around them.
constexpr std::int64_t kMargin = 48;

bool is_periodic(const MeshSettings& settings, unsigned axis) {
  return (settings.periodic >> axis & 1U) != 0;
}

std::int64_t along(Index3 v, unsigned axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Point moved(Point p, Index3 by) {
  const auto units = [](std::int64_t voxels) {
    return static_cast<std::int32_t>(voxels * kUnitsPerVoxel);
  };
  return {p.x - units(by.x), p.y - units(by.y), p.z - units(by.z)};
}

/// Returns the number of a corner in a volume (VertexId) from that in the volume with its margin.
VertexId id_within(VertexId id, Index3 volume, Index3 margin) {
  const auto at = static_cast<std::int64_t>(id);
  const Index3 corners = volume + margin + margin + Index3{1, 1, 1};
  const Index3 corner =
      Index3{at % corners.x, at / corners.x % corners.y, at / corners.x / corners.y} - margin;
  return static_cast<VertexId>((corner.z * (volume.y + 1) + corner.y) * (volume.x + 1) + corner.x);
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

BoxPlanes periodic_planes(const MeshSettings& settings) {
  unsigned planes = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (is_periodic(settings, axis)) planes |= 3U << 2 * axis;
  }
  return static_cast<BoxPlanes>(planes);
}

BlockMesh without_margin(BlockMesh mesh, Index3 volume, Index3 margin) {
  if (margin == Index3{}) return mesh;
  for (BlockVertex& v : mesh.vertices) {
    v.id = id_within(v.id, volume, margin);
    v.position = moved(v.position, margin);
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

void check_periodic(Index3 shape, const MeshSettings& settings) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::int64_t voxels = along(shape, axis);
    if (!is_periodic(settings, axis) || voxels % 2 == 0) continue;
    io::fail_usage("--periodic: the volume has ", voxels, " voxels along ",
                   std::string_view("xyz").substr(axis, 1),
                   "; a cell that repeats itself needs an even number: --crop it, slice an "
                   "array, or resample it");
  }
}

}  // namespace mw::engine
