// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Slots, parts and next uses against plain walks over all windows; the flow of blocks against the
// order of windows, and both of its directions against each other.
#include "engine/store/run_layout.h"

#include "engine/store/journal/identity.h"
#include "tests/engine/store/layouts.h"
#include "tests/testing.h"

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

/// Grids that begin elsewhere: whole() undoes parts(), and parts have the voxels of their block in
/// the volume.
TEST(RunLayout, PartsOfGridsThatBeginElsewhereFillTheirBlock) {
  std::mt19937 random(322);
  for (int i = 0; i < 60; ++i) {
    const auto any = [&](std::int64_t n) {
      return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
    };
    const Index3 volume{6 + any(9), 6 + any(9), 6 + any(9)};
    std::vector<WindowGrid> grids;
    for (const int window : {4, 8, 8}) {
      const Index3 blocks = WindowGrid(volume, window).blocks();
      grids.emplace_back(volume, window, Index3{any(blocks.x), any(blocks.y), any(blocks.z)});
    }
    const RunLayout layout(grids);
    for (std::uint32_t m = 1; m < layout.marches(); ++m) {
      for_each_index(layout.grid(m).blocks(), [&](Index3 b) {
        const WindowGrid &grid = layout.grid(m), &before = layout.grid(m - 1);
        const Box3 box = grid.block_box(b);
        std::int64_t voxels = 0;
        for (const BlockKey& part : layout.parts({m, b})) {
          EXPECT_EQ(layout.whole(part), (BlockKey{m, b}));
          const Index3 by = grid.beyond(b) - before.beyond(part.block);
          EXPECT_TRUE(box.contains(before.block_box(part.block).lo + by));
          voxels += before.block_box(part.block).voxels();
        }
        EXPECT_EQ(voxels, box.voxels());
      });
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

// What of a volume makes another run of it; the settings are in setting_table_test.cpp.

io::VolumeInfo some_volume() {
  return {.shape = {30, 20, 10}, .type = io::VoxelType::kU64, .format = "npy", .names = {}};
}

std::string identity(const io::VolumeInfo& volume) {
  return identity_text(volume, {});
}

TEST(RunIdentity, NamesWhatTheMeshComesFrom) {
  const io::VolumeInfo plain = some_volume();
  std::vector<io::VolumeInfo> others(8, plain);
  others[0].shape = {20, 30, 10};
  others[1].type = io::VoxelType::kI64;
  others[2].scaled = true;  // labels above 2^63 are negative then, and come first
  others[3].space.spacing = {1.0, 1.0, 1.0000000000000002};
  others[4].space.origin = {0.0, 0.0, 1e-300};
  others[5].space.axes = {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}};
  others[6].space.axes = {{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};
  others[7].space.axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
  std::set<std::string> identities{identity(plain)};
  for (const io::VolumeInfo& other : others) {
    EXPECT_TRUE(identities.insert(identity(other)).second) << identity(other);
    EXPECT_NE(differences(identity(plain), identity(other)), "");
  }
}

TEST(RunIdentity, LeavesOutHowTheVolumeIsStored) {
  io::VolumeInfo copy = some_volume();
  copy.format = "zarr";
  copy.z_fastest = true;
  copy.chunk = {16, 16, 16};
  copy.space.unit = "mm";
  EXPECT_EQ(identity(copy), identity(some_volume()));
}

/// So that a run that is refused is told every difference.
TEST(RunIdentity, HasALineForEachValue) {
  std::istringstream lines(identity(some_volume()));
  std::set<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" = ");
    ASSERT_NE(at, std::string::npos) << line;
    EXPECT_LT(at + 3, line.size()) << line;
    EXPECT_TRUE(names.insert(line.substr(0, at)).second) << line;
  }
  EXPECT_GE(names.size(), 20U);
}

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
