// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Allowed cells, from small to large.
#include "kernels/start/cells/cell_levels.h"

#include <algorithm>

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

CellLevels::CellLevels(const LabelBox& labels, Index3 volume, const Box3& asked, int max_level,
                       const SizeField* sizes)
    : labels_(labels), volume_(volume), sizes_(sizes) {
  find_levels(max_level);
  find_leaves(asked);
}

// More than five parameters: those of the other constructor, and the levels known before.
CellLevels::CellLevels(const LabelBox& labels, Index3 volume, const Box3& asked, int max_level,
                       const LevelMap& large, const SizeField* sizes)
    : labels_(labels), volume_(volume), sizes_(sizes) {
  find_leaves(asked);
  bool all_large = true;
  std::size_t i = 0;
  for_each_index(pairs_, [&](Index3 c) {
    int level = max_level;
    while (level > 2 && !large.is_allowed({2 * c.x, 2 * c.y, 2 * c.z}, level)) --level;
    leaves_[i++] = static_cast<std::uint8_t>(level > 2 ? level : 0);
    all_large = all_large && level > 2;
  });
  if (all_large) return;
  find_levels(std::min(max_level, 2));
  i = 0;
  for_each_index(pairs_, [&](Index3 c) {
    std::uint8_t& leaf = leaves_[i++];
    if (leaf == 0) leaf = small_level_at({2 * c.x, 2 * c.y, 2 * c.z});
  });
}

void CellLevels::find_levels(int highest) {
  known_ = intersection(labels_.box, {{0, 0, 0}, volume_});
  for (int k = 1; k <= highest; ++k) {
    Level level = cells_of(k);
    std::size_t i = 0;
    for_each_index(level.cells, [&](Index3 c) {
      level.allowed[i++] = is_uniform(c, k) && finer_allowed(c, k) && is_small(c, k) ? 1 : 0;
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
  // finer_allowed() tells whether each child is uniform, so one voxel of each is enough.
  const std::int64_t half = std::int64_t{1} << (level - 1);
  const Label first = labels_.at(voxels.lo);
  for (std::int64_t i = 1; i < 8; ++i) {
    const Index3 child{(i & 1) * half, (i >> 1 & 1) * half, (i >> 2 & 1) * half};
    if (labels_.at(voxels.lo + child) != first) return false;
  }
  return true;
}

bool CellLevels::is_small(Index3 cell, int level) const {
  if (sizes_ == nullptr) return true;
  const Index3 lo = voxels_of(cell, level).lo;
  return sizes_->allows_cell(lo, level, labels_.at(lo));
}

bool CellLevels::finer_allowed(Index3 cell, int level) const {
  if (level == 1) return true;
  const Level& finer = levels_[static_cast<std::size_t>(level - 2)];
  for (std::int64_t z = 2 * cell.z - 1; z < 2 * cell.z + 3; ++z) {
    for (std::int64_t y = 2 * cell.y - 1; y < 2 * cell.y + 3; ++y) {
      for (std::int64_t x = 2 * cell.x - 1; x < 2 * cell.x + 3; ++x) {
        // A cell that is not listed lies outside the volume, or too far away to matter.
        if (!finer.cells.contains({x, y, z})) continue;
        if (finer.allowed[static_cast<std::size_t>(finer.cells.offset({x, y, z}))] == 0) {
          return false;
        }
      }
    }
  }
  return true;
}

void CellLevels::find_leaves(const Box3& asked) {
  const Box3 known = intersection(asked, {{0, 0, 0}, volume_});
  pairs_ = {cell_at(known.lo, 1), cell_at(known.hi - Index3{1, 1, 1}, 1) + Index3{1, 1, 1}};
  leaves_.reserve(static_cast<std::size_t>(pairs_.voxels()));
  for_each_index(pairs_, [&](Index3 c) {
    leaves_.push_back(small_level_at({2 * c.x, 2 * c.y, 2 * c.z}));
  });
}

std::uint8_t CellLevels::small_level_at(Index3 voxel) const {
  for (auto k = static_cast<int>(levels_.size()); k > 0; --k) {
    const Level& level = levels_[static_cast<std::size_t>(k - 1)];
    const Index3 cell = cell_at(voxel, k);
    if (level.allowed[static_cast<std::size_t>(level.cells.offset(cell))] != 0)
      return static_cast<std::uint8_t>(k);
  }
  return 0;
}

}  // namespace mw
