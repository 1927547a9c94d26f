// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Allowed cells, from small to large.
#include "kernels/lattice/cell_levels.h"

#include <algorithm>

#include "kernels/core/each_index.h"

namespace mw {
namespace {

std::int64_t floor_shift(std::int64_t v, int level) {
  return v >> level;
}

Index3 cell_at(Index3 voxel, int level) {
  return {floor_shift(voxel.x, level), floor_shift(voxel.y, level), floor_shift(voxel.z, level)};
}

Box3 voxels_of(Index3 cell, int level) {
  const std::int64_t size = std::int64_t{1} << level;
  const Index3 lo{cell.x * size, cell.y * size, cell.z * size};
  return {lo, lo + Index3{size, size, size}};
}

bool inside(const Box3& a, const Box3& b) {
  return a.lo.x >= b.lo.x && a.lo.y >= b.lo.y && a.lo.z >= b.lo.z && a.hi.x <= b.hi.x &&
         a.hi.y <= b.hi.y && a.hi.z <= b.hi.z;
}

}  // namespace

CellLevels::CellLevels(const LabelBox& labels, Index3 volume, int max_level)
    : labels_(labels), volume_(volume), max_level_(max_level) {
  find_levels(max_level);
}

CellLevels::CellLevels(const LabelBox& labels, Index3 volume, int max_level, const LevelMap& large)
    : labels_(labels), volume_(volume), large_(&large), max_level_(max_level) {
  find_levels(std::min(max_level, 2));
}

void CellLevels::find_levels(int highest) {
  const Box3& box = labels_.box;
  known_ = {{std::max<std::int64_t>(box.lo.x, 0), std::max<std::int64_t>(box.lo.y, 0),
             std::max<std::int64_t>(box.lo.z, 0)},
            {std::min(box.hi.x, volume_.x), std::min(box.hi.y, volume_.y),
             std::min(box.hi.z, volume_.z)}};
  for (int k = 1; k <= highest; ++k) {
    Level level = cells_of(k);
    std::size_t i = 0;
    each_index(level.cells, [&](Index3 c) {
      level.allowed[i++] = is_uniform(c, k) && finer_allowed(c, k) ? 1 : 0;
    });
    levels_.push_back(std::move(level));
  }
}

CellLevels::Level CellLevels::cells_of(int level) const {
  const Index3 last = known_.hi - Index3{1, 1, 1};
  Level out{{cell_at(known_.lo, level), cell_at(last, level) + Index3{1, 1, 1}}, {}};
  out.allowed.assign(static_cast<std::size_t>(out.cells.voxels()), 0);
  return out;
}

bool CellLevels::is_uniform(Index3 cell, int level) const {
  const Box3 voxels = voxels_of(cell, level);
  if (!inside(voxels, known_)) return false;
  // Whether the children are uniform, finer_allowed() tells; one voxel of each decides.
  const std::int64_t half = std::int64_t{1} << (level - 1);
  const Label first = labels_.at(voxels.lo);
  for (std::int64_t i = 1; i < 8; ++i) {
    const Index3 child{(i & 1) * half, (i >> 1 & 1) * half, (i >> 2 & 1) * half};
    if (labels_.at(voxels.lo + child) != first) return false;
  }
  return true;
}

bool CellLevels::finer_allowed(Index3 cell, int level) const {
  if (level == 1) return true;
  const Level& finer = levels_[static_cast<std::size_t>(level - 2)];
  for (std::int64_t z = 2 * cell.z - 1; z < 2 * cell.z + 3; ++z) {
    for (std::int64_t y = 2 * cell.y - 1; y < 2 * cell.y + 3; ++y) {
      for (std::int64_t x = 2 * cell.x - 1; x < 2 * cell.x + 3; ++x) {
        // What is not listed lies outside the volume, or too far away to matter.
        if (!finer.cells.contains({x, y, z})) continue;
        if (finer.allowed[static_cast<std::size_t>(finer.cells.offset({x, y, z}))] == 0) {
          return false;
        }
      }
    }
  }
  return true;
}

int CellLevels::level_at(Index3 voxel) const {
  for (int k = large_ != nullptr ? max_level_ : 0; k > 2; --k) {
    if (large_->is_allowed(voxel, k)) return k;
  }
  for (auto k = static_cast<int>(levels_.size()); k > 0; --k) {
    const Level& level = levels_[static_cast<std::size_t>(k - 1)];
    const Index3 cell = cell_at(voxel, k);
    if (level.allowed[static_cast<std::size_t>(level.cells.offset(cell))] != 0) return k;
  }
  return 0;
}

}  // namespace mw
