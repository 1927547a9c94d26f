// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Arithmetic of slots and of the run's time line.
#include "engine/store/run_layout.h"

#include <algorithm>
#include <utility>

#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

std::uint64_t count(Index3 shape) {
  return static_cast<std::uint64_t>(shape.product());
}

/// Returns the march of a slot or a window, from the first number of each march.
std::uint32_t march_of(const std::vector<std::uint64_t>& firsts, std::uint64_t number) {
  const auto next = std::upper_bound(firsts.begin(), firsts.end(), number);
  return static_cast<std::uint32_t>(next - firsts.begin() - 1);
}

}  // namespace

RunLayout::RunLayout(std::vector<WindowGrid> grids, Order order)
    : grids_(std::move(grids)), order_(order), first_slot_{0}, first_window_{0} {
  for (const WindowGrid& grid : grids_) {
    first_slot_.push_back(first_slot_.back() + count(grid.blocks()));
    first_window_.push_back(first_window_.back() + count(grid.windows()));
  }
}

std::uint64_t RunLayout::slot(const BlockKey& key) const {
  MW_ASSERT(key.march < grids_.size());
  return first_slot_[key.march] + raster(key.block, grids_[key.march].blocks());
}

BlockKey RunLayout::key(std::uint64_t slot) const {
  MW_ASSERT(slot < slots());
  const std::uint32_t march = march_of(first_slot_, slot);
  return {march, index_at(slot - first_slot_[march], grids_[march].blocks())};
}

std::uint64_t RunLayout::window(const WindowKey& key) const {
  return first_window_[key.march] + raster(key.window, grids_[key.march].windows());
}

WindowKey RunLayout::window_key(std::uint64_t window) const {
  MW_ASSERT(window < windows());
  const std::uint32_t march = march_of(first_window_, window);
  return {march, index_at(window - first_window_[march], grids_[march].windows())};
}

std::vector<BlockKey> RunLayout::blocks_of(const WindowKey& key) const {
  std::vector<BlockKey> out;
  for (Index3 block : grid(key.march).blocks_of(key.window)) out.push_back({key.march, block});
  return out;
}

std::vector<BlockKey> RunLayout::parts(const BlockKey& key) const {
  MW_ASSERT(key.march > 0);
  const Box3 before{{0, 0, 0}, grids_[key.march - 1].blocks()};
  std::vector<BlockKey> out;
  for_each_index(Index3{2, 2, 2}, [&](Index3 i) {
    const Index3 part{2 * key.block.x + i.x, 2 * key.block.y + i.y, 2 * key.block.z + i.z};
    if (before.contains(part)) out.push_back({key.march - 1, part});
  });
  return out;
}

/// Windows are one block apart, two blocks wide.
Box3 RunLayout::windows_over(const BlockKey& key) const {
  const auto first = [](std::int64_t b) { return std::max<std::int64_t>(0, b - 1); };
  const auto end = [](std::int64_t b, std::int64_t windows) {
    return std::min(b, windows - 1) + 1;
  };
  const Index3 block = key.block, w = grids_[key.march].windows();
  return {{first(block.x), first(block.y), first(block.z)},
          {end(block.x, w.x), end(block.y, w.y), end(block.z, w.z)}};
}

std::optional<std::uint64_t> RunLayout::next_window(const BlockKey& key,
                                                    const DoneWindows& done) const {
  const WindowOrder of_march = order(key.march);
  std::optional<std::uint64_t> next;
  for_each_index(windows_over(key), [&](Index3 w) {
    if (done.contains(window({key.march, w}))) return;
    const std::uint64_t time = first_window_[key.march] + of_march.rank(w);
    if (!next || time < *next) next = time;
  });
  return next;
}

std::uint64_t RunLayout::next_use(const BlockKey& key, const DoneWindows& done) const {
  if (const auto window = next_window(key, done)) return *window;
  if (key.march + 1 == marches()) return windows() + raster(key.block, grids_.back().blocks());
  return next_use({key.march + 1, {key.block.x / 2, key.block.y / 2, key.block.z / 2}}, done);
}

}  // namespace mw::engine
