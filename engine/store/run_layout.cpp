// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Arithmetic of slots and of the run's time line, and the windows over a block, by their ranks.
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
    : grids_(std::move(grids)),
      output_grid_(grids_.back().volume(), static_cast<int>(2 * grids_.back().block_edge())),
      order_(order),
      first_slot_{0},
      first_window_{0} {
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
  const WindowGrid& before = grids_[key.march - 1];
  const std::int64_t times = grids_[key.march].block_edge() / before.block_edge();
  const Index3 block = grids_[key.march].in_volume(key.block);
  const Index3 lo{times * block.x, times * block.y, times * block.z};
  std::vector<BlockKey> out;
  for_each_index(intersection({lo, lo + Index3{times, times, times}}, {{0, 0, 0}, before.blocks()}),
                 [&](Index3 part) {
                   out.push_back({key.march - 1, before.in_grid(part)});
                 });
  return out;
}

BlockKey RunLayout::whole(const BlockKey& key) const {
  MW_ASSERT(key.march + 1 < marches());
  const WindowGrid& next = grids_[key.march + 1];
  const std::int64_t times = next.block_edge() / grids_[key.march].block_edge();
  const Index3 block = grids_[key.march].in_volume(key.block);
  return {key.march + 1, next.in_grid({block.x / times, block.y / times, block.z / times})};
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
  if (key.march + 1 == marches())
    return windows() + raster(grids_.back().in_volume(key.block), grids_.back().blocks());
  return next_use(whole(key), done);
}

/// The first window over the block whose rank is `rank` or more.
std::optional<WindowKey> BlockRoute::after(const BlockKey& block, std::uint64_t rank) const {
  const WindowOrder order = layout_.order(block.march);
  std::optional<Index3> first;
  for_each_index(layout_.windows_over(block), [&](Index3 w) {
    if (order.rank(w) < rank) return;
    if (!first || order.rank(w) < order.rank(*first)) first = w;
  });
  if (!first) return std::nullopt;
  return WindowKey{block.march, *first};
}

/// The last window over the block whose rank is below `rank`.
std::optional<WindowKey> BlockRoute::before(const BlockKey& block, std::uint64_t rank) const {
  const WindowOrder order = layout_.order(block.march);
  std::optional<Index3> last;
  for_each_index(layout_.windows_over(block), [&](Index3 w) {
    if (order.rank(w) >= rank) return;
    if (!last || order.rank(w) > order.rank(*last)) last = w;
  });
  if (!last) return std::nullopt;
  return WindowKey{block.march, *last};
}

std::optional<WindowKey> BlockRoute::next_user(const BlockVersion& version) const {
  const BlockKey& block = version.block;
  MW_ASSERT(version.from.march == block.march);
  const std::uint64_t rank = layout_.order(block.march).rank(version.from.window);
  if (const auto next = after(block, rank + 1)) return next;
  if (block.march + 1 == layout_.marches()) return std::nullopt;
  return after(layout_.whole(block), 0);
}

BlockVersion BlockRoute::last_version(const BlockKey& block) const {
  return {block, before(block, layout_.order(block.march).size()).value()};
}

std::vector<BlockVersion> BlockRoute::inputs(const WindowKey& key) const {
  const std::uint64_t rank = layout_.order(key.march).rank(key.window);
  std::vector<BlockVersion> out;
  for (Index3 index : layout_.grid(key.march).blocks_of(key.window)) {
    const BlockKey block{key.march, index};
    if (const auto from = before(block, rank)) {
      out.push_back({block, *from});
    } else if (key.march > 0) {
      for (const BlockKey& part : layout_.parts(block)) out.push_back(last_version(part));
    }
  }
  return out;
}

}  // namespace mw::engine
