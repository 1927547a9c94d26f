// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Arithmetic of blocks and windows.
#include "engine/window/window_grid.h"

#include <algorithm>

namespace mw::engine {
namespace {

std::int64_t ceil_div(std::int64_t a, std::int64_t b) {
  return (a + b - 1) / b;
}

std::int64_t windows_along(std::int64_t blocks) {
  return std::max<std::int64_t>(1, blocks - 1);
}

}  // namespace

WindowGrid::WindowGrid(Index3 volume, int window)
    : volume_(volume),
      block_edge_(window / 2),
      blocks_{ceil_div(volume.x, block_edge_), ceil_div(volume.y, block_edge_),
              ceil_div(volume.z, block_edge_)},
      windows_{windows_along(blocks_.x), windows_along(blocks_.y), windows_along(blocks_.z)} {}

Box3 WindowGrid::block_box(Index3 block) const {
  const Index3 lo{block.x * block_edge_, block.y * block_edge_, block.z * block_edge_};
  return {lo,
          {std::min(lo.x + block_edge_, volume_.x), std::min(lo.y + block_edge_, volume_.y),
           std::min(lo.z + block_edge_, volume_.z)}};
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

Index3 WindowGrid::owner(Index3 window, const std::array<std::int64_t, 3>& sum) const {
  const std::int64_t unit = 4 * block_edge_ * kUnitsPerVoxel;
  const auto along = [&](std::int64_t s, std::int64_t w, std::int64_t blocks) {
    return std::clamp(s / unit, w, std::min(w + 1, blocks - 1));
  };
  return {along(sum[0], window.x, blocks_.x), along(sum[1], window.y, blocks_.y),
          along(sum[2], window.z, blocks_.z)};
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
