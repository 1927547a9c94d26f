// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Arithmetic of blocks and windows.
#include "engine/window/window_grid.h"

#include <algorithm>
#include <limits>

namespace mw::engine {
namespace {

std::int64_t ceil_div(std::int64_t a, std::int64_t b) {
  return (a + b - 1) / b;
}

std::int64_t windows_along(std::int64_t blocks) {
  return std::max<std::int64_t>(1, blocks - 1);
}

}  // namespace

WindowGrid::WindowGrid(Index3 volume, int window, Index3 first)
    : volume_(volume),
      block_edge_(window / 2),
      first_(first),
      blocks_{ceil_div(volume.x, block_edge_), ceil_div(volume.y, block_edge_),
              ceil_div(volume.z, block_edge_)},
      windows_{windows_along(blocks_.x), windows_along(blocks_.y), windows_along(blocks_.z)} {}

Index3 WindowGrid::in_volume(Index3 block) const {
  const auto along = [](std::int64_t b, std::int64_t first, std::int64_t blocks) {
    return (b + first) % blocks;
  };
  return {along(block.x, first_.x, blocks_.x), along(block.y, first_.y, blocks_.y),
          along(block.z, first_.z, blocks_.z)};
}

Index3 WindowGrid::in_grid(Index3 block) const {
  const auto along = [](std::int64_t b, std::int64_t first, std::int64_t blocks) {
    return (b - first + blocks) % blocks;
  };
  return {along(block.x, first_.x, blocks_.x), along(block.y, first_.y, blocks_.y),
          along(block.z, first_.z, blocks_.z)};
}

Index3 WindowGrid::beyond(Index3 block) const {
  const auto along = [](std::int64_t b, std::int64_t first, std::int64_t blocks,
                        std::int64_t volume) { return b + first < blocks ? 0 : volume; };
  return {along(block.x, first_.x, blocks_.x, volume_.x),
          along(block.y, first_.y, blocks_.y, volume_.y),
          along(block.z, first_.z, blocks_.z, volume_.z)};
}

Box3 WindowGrid::block_box(Index3 block) const {
  const Index3 b = in_volume(block), copy = beyond(block);
  const Index3 lo{b.x * block_edge_, b.y * block_edge_, b.z * block_edge_};
  const Index3 hi{std::min(lo.x + block_edge_, volume_.x), std::min(lo.y + block_edge_, volume_.y),
                  std::min(lo.z + block_edge_, volume_.z)};
  return {lo + copy, hi + copy};
}

Box3 WindowGrid::window_box(Index3 window) const {
  const std::vector<Index3> blocks = blocks_of(window);
  return {block_box(blocks.front()).lo, block_box(blocks.back()).hi};
}

std::vector<Index3> WindowGrid::blocks_of(Index3 window) const {
  std::vector<Index3> out;
  for (std::int64_t z = window.z; z < std::min(window.z + 2, blocks_.z); ++z) {
    for (std::int64_t y = window.y; y < std::min(window.y + 2, blocks_.y); ++y) {
      for (std::int64_t x = window.x; x < std::min(window.x + 2, blocks_.x); ++x) {
        out.push_back({x, y, z});
      }
    }
  }
  return out;
}

std::array<std::int64_t, 3> WindowGrid::least_sums_above(Index3 window) const {
  const std::int64_t voxel = 4 * kUnitsPerVoxel, unit = voxel * block_edge_;
  const auto along = [&](std::int64_t w, std::int64_t first, std::int64_t blocks,
                         std::int64_t volume) {
    if (w + 1 >= blocks) return std::numeric_limits<std::int64_t>::max();
    const std::int64_t upper = w + 1 + first;
    return upper < blocks ? upper * unit : voxel * volume + (upper - blocks) * unit;
  };
  return {along(window.x, first_.x, blocks_.x, volume_.x),
          along(window.y, first_.y, blocks_.y, volume_.y),
          along(window.z, first_.z, blocks_.z, volume_.z)};
}

Index3 WindowGrid::owner(Index3 window, const std::array<std::int64_t, 3>& sum) const {
  const auto [x, y, z] = least_sums_above(window);
  return window + Index3{sum[0] >= x ? 1 : 0, sum[1] >= y ? 1 : 0, sum[2] >= z ? 1 : 0};
}

std::vector<Index3> WindowGrid::predecessors(Index3 w) const {
  const std::int64_t next_x = std::min(w.x + 1, windows_.x - 1);
  const std::int64_t next_y = std::min(w.y + 1, windows_.y - 1);
  std::vector<Index3> out;
  if (w.x > 0) out.push_back({w.x - 1, w.y, w.z});
  if (w.y > 0) out.push_back({next_x, w.y - 1, w.z});
  if (w.z > 0) out.push_back({next_x, next_y, w.z - 1});
  return out;
}

}  // namespace mw::engine
