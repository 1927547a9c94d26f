// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Slots, parts and next uses against plain walks over all windows.
#include "engine/store/run_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace mw::engine {
namespace {

std::vector<WindowGrid> grids_of(Index3 volume, int marches) {
  std::vector<WindowGrid> grids;
  for (int i = 0, window = 4; i < marches; ++i, window *= 2) grids.emplace_back(volume, window);
  return grids;
}

constexpr std::array<Index3, 5> kVolumes{
    {{9, 8, 7}, {20, 3, 1}, {2, 2, 2}, {13, 5, 8}, {4, 17, 6}}};

TEST(RunLayout, NumbersEachBlockAndWindowOnce) {
  for (Index3 volume : kVolumes) {
    const RunLayout layout(grids_of(volume, 3));
    std::set<std::uint64_t> slots, windows;
    for (std::uint32_t m = 0; m < layout.marches(); ++m) {
      for_each_index(layout.grid(m).blocks(), [&](Index3 b) {
        const std::uint64_t slot = layout.slot({m, b});
        EXPECT_EQ(layout.key(slot), (BlockKey{m, b}));
        EXPECT_TRUE(slots.insert(slot).second);
      });
      for_each_index(layout.grid(m).windows(), [&](Index3 w) {
        EXPECT_TRUE(windows.insert(layout.window({m, w})).second);
      });
    }
    EXPECT_EQ(slots.size(), layout.slots());
    EXPECT_EQ(*slots.rbegin() + 1, layout.slots());
    EXPECT_EQ(windows.size(), layout.windows());
    EXPECT_EQ(*windows.rbegin() + 1, layout.windows());
  }
}

TEST(RunLayout, PartsFillTheirBlock) {
  for (Index3 volume : kVolumes) {
    const RunLayout layout(grids_of(volume, 3));
    for (std::uint32_t m = 1; m < layout.marches(); ++m) {
      std::size_t parts = 0;
      for_each_index(layout.grid(m).blocks(), [&](Index3 b) {
        const Box3 box = layout.grid(m).block_box(b);
        std::int64_t voxels = 0;
        for (const BlockKey& part : layout.parts({m, b})) {
          const Box3 inside = layout.grid(m - 1).block_box(part.block);
          EXPECT_TRUE(box.contains(inside.lo));
          voxels += inside.voxels();
          ++parts;
        }
        EXPECT_EQ(voxels, box.voxels());
      });
      EXPECT_EQ(parts, static_cast<std::size_t>(layout.grid(m - 1).blocks().product()));
    }
  }
}

/// All windows of the run in order; those that touch the block's voxels use it.
TEST(RunLayout, NextUseIsTheFirstWindowLeftThatTouchesTheBlock) {
  std::mt19937 random(321);
  for (Index3 volume : kVolumes) {
    const RunLayout layout(grids_of(volume, 2));
    DoneWindows done(layout.windows());
    std::vector<WindowKey> all;
    for (std::uint32_t m = 0; m < layout.marches(); ++m) {
      for_each_index(layout.grid(m).windows(), [&](Index3 w) { all.push_back({m, w}); });
    }
    const auto uses = [&](const WindowKey& w, const BlockKey& key) {
      const Index3 corner = layout.grid(key.march).block_box(key.block).lo;
      const auto blocks = layout.grid(w.march).blocks_of(w.window);
      return w.march >= key.march && std::any_of(blocks.begin(), blocks.end(), [&](Index3 b) {
               return layout.grid(w.march).block_box(b).contains(corner);
             });
    };
    for (int round = 0; round < 4; ++round) {
      for (std::uint64_t slot = 0; slot < layout.slots(); ++slot) {
        const BlockKey key = layout.key(slot);
        std::uint64_t expected = 0;
        while (expected < all.size() && (done.contains(expected) || !uses(all[expected], key))) {
          ++expected;
        }
        if (expected < all.size()) {
          EXPECT_EQ(layout.next_use(key, done), expected);
        } else {
          EXPECT_GE(layout.next_use(key, done), layout.windows());
        }
      }
      for (std::uint64_t w = 0; w < layout.windows(); ++w) {
        if (random() % 2 == 0) done.insert(w);
      }
    }
  }
}

}  // namespace
}  // namespace mw::engine
