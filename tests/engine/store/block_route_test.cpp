// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The flow of blocks against the order of windows, and both of its directions against each other.
#include "engine/store/block_route.h"
#include "tests/engine/store/layouts.h"

namespace mw::engine {
namespace {

using namespace test;

TEST(BlockRoute, InputsOfAMarchOrderItsWindowsAsItsEdgesDo) {
  for_layouts([](const RunLayout& layout) {
    const BlockRoute route(layout);
    const WindowOrder order = layout.order(0);
    Relation flow(order.size(), std::vector<bool>(order.size(), false));
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
      for (const BlockVersion& v : route.inputs({0, order.window(rank)})) {
        flow[rank][order.rank(v.from.window)] = true;
      }
    }
    EXPECT_EQ(transitive_closure(flow), transitive_closure(by_edges(order)));
  });
}

/// Plays the run in sequence: what is the latest version of each block is found by looking.
TEST(BlockRoute, InputsAreTheLatestVersions) {
  for_layouts([](const RunLayout& layout) {
    const BlockRoute route(layout);
    std::map<std::uint64_t, WindowKey> latest;  // by slot
    for (std::uint32_t march = 0; march < layout.marches(); ++march) {
      const WindowOrder order = layout.order(march);
      for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
        const WindowKey key{march, order.window(rank)};
        std::vector<BlockVersion> expected;
        for (Index3 index : layout.grid(march).blocks_of(key.window)) {
          const BlockKey block{march, index};
          const auto own = latest.find(layout.slot(block));
          if (own != latest.end()) {
            expected.push_back({block, own->second});
          } else if (march > 0) {
            for (const BlockKey& part : layout.parts(block)) {
              expected.push_back({part, latest.at(layout.slot(part))});
            }
          }
          latest[layout.slot(block)] = key;
        }
        EXPECT_EQ(route.inputs(key), expected);
      }
    }
    for_each_index(layout.grid(layout.marches() - 1).blocks(), [&](Index3 index) {
      const BlockKey block{layout.marches() - 1, index};
      EXPECT_EQ(route.last_version(block), (BlockVersion{block, latest.at(layout.slot(block))}));
    });
  });
}

TEST(BlockRoute, EveryVersionHasOneNextUserWhoseInputItIs) {
  for_layouts([](const RunLayout& layout) {
    const BlockRoute route(layout);
    std::size_t used = 0, taken = 0, output = 0;
    for_windows(layout, [&](const WindowKey& key) {
      taken += route.inputs(key).size();
      for (Index3 index : layout.grid(key.march).blocks_of(key.window)) {
        const BlockVersion version{{key.march, index}, key};
        const auto next = route.next_user(version);
        if (!next) {
          EXPECT_EQ(route.last_version(version.block), version);
          ++output;
          continue;
        }
        ++used;
        const std::vector<BlockVersion> inputs = route.inputs(*next);
        EXPECT_EQ(std::count(inputs.begin(), inputs.end(), version), 1);
      }
    });
    EXPECT_EQ(used, taken);
    EXPECT_EQ(static_cast<std::int64_t>(output),
              layout.grid(layout.marches() - 1).blocks().product());
  });
}

}  // namespace
}  // namespace mw::engine
