// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Goes back from what visits ask for to what has to be read; each step adds a halo.
#include "engine/labels/label_need.h"

#include <algorithm>

#include "engine/labels/reading_tiles.h"
#include "kernels/start/coarsen/coarsen.h"
#include "kernels/start/graded_start.h"

namespace mw::engine {
namespace {

/// A start mesh asks for the octree's leaves a voxel around its block, in pairs of voxels.
constexpr std::int64_t kLeafHalo = 2;
// Each of the steps below adds one brick on each side.
static_assert(kCoarsenHalo <= kBrick && LevelMap::kHalo <= kBrick && LevelMap::kCube == kBrick);

Box3 bricks_around(const Box3& voxels, std::int64_t halo, Index3 volume) {
  if (is_empty(voxels)) return {};
  return bricks_over(intersection(grown(voxels, halo), {{0, 0, 0}, volume}));
}

Box3 wider(const Box3& bricks, const Box3& all) {
  return is_empty(bricks) ? Box3{} : intersection(grown(bricks, 1), all);
}

}  // namespace

bool is_coarsened(const MeshSettings& settings) {
  // Coarsening keeps the topology of labels, not that of interfaces.
  return settings.start == StartMesh::kCoarse && settings.topology == KeptTopology::kLabels;
}

bool wants_source(const MeshSettings& settings, bool has_scores) {
  return (settings.sizes.rules.any() || has_scores) && settings.surface == Surface::kSmooth &&
         settings.max_distance.has_value();
}

NeededBricks bricks_of(Index3 volume) {
  const Box3 all = bricks_over({{0, 0, 0}, volume});
  return {all, all, all};
}

NeededBricks bricks_of(const LabelNeed& need, Index3 volume, const MeshSettings& settings) {
  const NeededBricks all = bricks_of(volume);
  if (settings.sizes.limits_edges()) return all;
  NeededBricks out;
  out.shapes = bricks_around(need.starts, kStartHalo, volume);
  if (settings.start != StartMesh::kDense) {
    // Whether a cell of 16 voxels may be there depends on neighbours of 8, and these on the labels.
    out.levels = wider(bricks_around(need.starts, kLeafHalo, volume), all.levels);
    out.shapes = hull(out.shapes, wider(out.levels, all.shapes));
  }
  out.original = is_coarsened(settings) ? wider(out.shapes, all.original) : out.shapes;
  out.original = hull(out.original, bricks_around(need.near, 0, volume));
  return out;
}

}  // namespace mw::engine
