// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells of the whole volume: whole cubes by the eighths of their neighbours.
#include "kernels/start/cells/cell_levels.h"

namespace mw {
namespace {

constexpr std::int64_t kEighth = LevelMap::kCube / 2;

std::int64_t cubes_along(std::int64_t voxels) {
  return (voxels + LevelMap::kCube - 1) / LevelMap::kCube;
}

Index3 cube_at(Index3 voxel) {
  return {voxel.x / LevelMap::kCube, voxel.y / LevelMap::kCube, voxel.z / LevelMap::kCube};
}

unsigned eighth_at(Index3 voxel) {
  return static_cast<unsigned>((voxel.x / kEighth & 1) | (voxel.y / kEighth & 1) << 1 |
                               (voxel.z / kEighth & 1) << 2);
}

}  // namespace

LevelMap::LevelMap(Index3 volume)
    : LevelMap(volume,
               {{0, 0, 0}, {cubes_along(volume.x), cubes_along(volume.y), cubes_along(volume.z)}}) {
}

LevelMap::LevelMap(Index3 volume, const Box3& held)
    : volume_(volume),
      cubes_{cubes_along(volume.x), cubes_along(volume.y), cubes_along(volume.z)},
      held_(held),
      eighths_(static_cast<std::size_t>(held.voxels()), 0),
      whole_(eighths_.size(), 0) {}

/// Cubes whose neighbours are all held, or outside the volume.
Box3 LevelMap::decided() const {
  const auto lower = [](std::int64_t lo) { return lo == 0 ? 0 : lo + 1; };
  const auto upper = [](std::int64_t hi, std::int64_t all) { return hi == all ? hi : hi - 1; };
  return {{lower(held_.lo.x), lower(held_.lo.y), lower(held_.lo.z)},
          {upper(held_.hi.x, cubes_.x), upper(held_.hi.y, cubes_.y), upper(held_.hi.z, cubes_.z)}};
}

std::uint8_t LevelMap::allowed_eighths(const LabelBox& labels, Index3 volume, Index3 cube,
                                       const SizeField* sizes) {
  const Index3 lo{cube.x * kCube, cube.y * kCube, cube.z * kCube};
  const CellLevels levels(labels, volume, {lo, lo + Index3{kCube, kCube, kCube}}, 3, sizes);
  unsigned bits = 0;
  for_each_index(Index3{2, 2, 2}, [&](Index3 i) {
    const Index3 voxel = lo + Index3{i.x * kEighth, i.y * kEighth, i.z * kEighth};
    const bool inside = Box3{{0, 0, 0}, volume}.contains(voxel);
    if (inside && levels.level_at(voxel) == 3) bits |= 1U << eighth_at(voxel);
  });
  return static_cast<std::uint8_t>(bits);
}

bool LevelMap::eighths_around_allowed(Index3 cube) const {
  const Index3 lo{cube.x * kCube, cube.y * kCube, cube.z * kCube};
  bool all = true;
  for_each_index(Box3{{-1, -1, -1}, {3, 3, 3}}, [&](Index3 i) {
    const Index3 voxel = lo + Index3{i.x * kEighth, i.y * kEighth, i.z * kEighth};
    if (!Box3{{0, 0, 0}, volume_}.contains(voxel)) return;
    all = all && is_allowed(voxel, 3);
  });
  return all;
}

bool LevelMap::is_allowed(Index3 voxel, int level) const {
  if (!Box3{{0, 0, 0}, volume_}.contains(voxel)) return false;
  const std::size_t at = row(cube_at(voxel));
  return level == 4 ? whole_[at] != 0 : (unsigned{eighths_[at]} >> eighth_at(voxel) & 1U) != 0;
}

}  // namespace mw
