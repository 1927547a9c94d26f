// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Final blocks stay where they were visited last.
#include "engine/team/output/line_share.h"

#include <gtest/gtest.h>

#include "tests/engine/march/grids.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;

TEST(LineOwners, HaveVisitedAllBlocksOfTheirLinesLast) {
  std::mt19937 random(521);
  std::size_t shared = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto edge = [&] { return std::int64_t{1 + below(random, 40)}; };
    const auto x = edge(), y = edge(), z = edge();
    std::vector<WindowGrid> grids;
    for (std::uint32_t march = 0; march <= i % 3; ++march) {
      grids.emplace_back(Index3{x, y, z}, 4 << march);
    }
    const Order order = i % 2 == 0 ? Order::kRaster : Order::kColour;
    const RunLayout layout(grids, order);
    const Partition partition(layout, order, 1 + static_cast<int>(below(random, 9)));
    const std::vector<std::uint32_t> owners = line_owners(layout, partition);
    const std::uint32_t last = layout.marches() - 1;
    const Index3 blocks = layout.grid(last).blocks();
    ASSERT_EQ(owners.size(), static_cast<std::size_t>(blocks.y * blocks.z));
    const BlockRoute route(layout);
    for_each_index(blocks, [&](Index3 b) {
      const auto owner = owners[static_cast<std::size_t>(b.z * blocks.y + b.y)];
      EXPECT_EQ(partition.rank_of(route.last_version({last, b}).from), static_cast<int>(owner));
      shared += owner != owners[0];
    });
  }
  EXPECT_GT(shared, 1000U);
}

}  // namespace
}  // namespace mw::engine
