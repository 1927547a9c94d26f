// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/keep/window_records.h"
#include "tests/engine/store/layouts.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;
using namespace test;

/// How far a window is from those that the last run visited, by their boxes.
std::int64_t gap(const RunLayout& layout, std::uint64_t window, const Box3& visited) {
  const WindowKey key = layout.window_key(window);
  const Box3 box = layout.grid(key.march).window_box(key.window);
  for (std::int64_t out = 0;; ++out) {
    const Box3 wide = grown(box, out);
    const Box3 touching{{wide.lo.x - 1, wide.lo.y - 1, wide.lo.z - 1}, wide.hi + Index3{1, 1, 1}};
    if (!is_empty(intersection(touching, visited))) return out;
  }
}

TEST(DropOrder, BeginsWithTheEarliestRunsFarFromTheLastVisits) {
  std::mt19937 random(73);
  const WindowGrid first = grid_of({7, 6, 5});
  const RunLayout layout({first, WindowGrid(first.volume(), 8)}, Order::kColour);
  for (int i = 0; i < 20; ++i) {
    constexpr std::uint32_t kLastRun = 4;
    std::vector<KeptBytes> kept;
    Box3 visited;
    std::size_t finals = 0;
    for_windows(layout, [&](const WindowKey& key) {
      if (below(random, 4) == 0) return;
      const std::uint32_t run = below(random, 12) == 0 ? kLastRun : 1 + below(random, 3);
      kept.push_back({layout.window(key), run, 100});
      if (leaves_final_block(layout, key)) ++finals;
      if (run < kLastRun) return;
      visited = hull(visited, layout.grid(key.march).window_box(key.window));
    });
    const std::vector<KeptBytes> order = drop_order(layout, kept, kLastRun);
    EXPECT_EQ(order.size() + finals, kept.size());
    for (std::size_t n = 1; n < order.size(); ++n) {
      const KeptBytes &a = order[n - 1], &b = order[n];
      EXPECT_LE(a.run, b.run);
      if (a.run < b.run) continue;
      const std::int64_t of_a = gap(layout, a.window, visited);
      const std::int64_t of_b = gap(layout, b.window, visited);
      EXPECT_TRUE(of_a > of_b || (of_a == of_b && a.window > b.window));
    }
  }
}

}  // namespace
}  // namespace mw::engine
