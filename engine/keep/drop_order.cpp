// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/drop_order.h"

#include <algorithm>
#include <tuple>

#include "engine/store/block_route.h"

namespace mw::engine {
namespace {

Box3 box_of(const RunLayout& layout, std::uint64_t window) {
  const WindowKey key = layout.window_key(window);
  return layout.grid(key.march).window_box(key.window);
}

/// Returns the largest gap between two boxes along an axis; 0 where they touch.
std::int64_t distance(const Box3& a, const Box3& b) {
  const auto gap = [](std::int64_t a_lo, std::int64_t a_hi, std::int64_t b_lo, std::int64_t b_hi) {
    return std::max({std::int64_t{0}, a_lo - b_hi, b_lo - a_hi});
  };
  return std::max({gap(a.lo.x, a.hi.x, b.lo.x, b.hi.x), gap(a.lo.y, a.hi.y, b.lo.y, b.hi.y),
                   gap(a.lo.z, a.hi.z, b.lo.z, b.hi.z)});
}

}  // namespace

bool leaves_final_block(const RunLayout& layout, const WindowKey& key) {
  if (key.march + 1 < layout.marches()) return false;
  const BlockRoute route(layout);
  const auto blocks = layout.grid(key.march).blocks_of(key.window);
  return std::any_of(blocks.begin(), blocks.end(), [&](Index3 block) {
    return !route.next_user({{key.march, block}, key});
  });
}

std::vector<KeptBytes> drop_order(const RunLayout& layout, std::vector<KeptBytes> kept,
                                  std::uint32_t last_run) {
  Box3 visited;
  for (const KeptBytes& k : kept) {
    if (k.run == last_run) visited = hull(visited, box_of(layout, k.window));
  }
  std::erase_if(kept, [&](const KeptBytes& k) {
    return leaves_final_block(layout, layout.window_key(k.window));
  });
  const auto turn = [&](const KeptBytes& k) {
    return std::tuple(k.run, -distance(box_of(layout, k.window), visited), ~k.window);
  };
  std::sort(kept.begin(), kept.end(),
            [&](const KeptBytes& a, const KeptBytes& b) { return turn(a) < turn(b); });
  return kept;
}

}  // namespace mw::engine
