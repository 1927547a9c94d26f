// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The windows over a block, by their ranks.
#include "engine/store/block_route.h"

#include "kernels/core/assert.h"

namespace mw::engine {

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
  return after({block.march + 1, {block.block.x / 2, block.block.y / 2, block.block.z / 2}}, 0);
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
