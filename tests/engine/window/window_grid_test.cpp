// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sec 4.1: blocks tile the volume, windows cover them, and predecessors order all that touch.
#include "engine/window/window_grid.h"
#include "engine/window/window_visitor.h"
#include "tests/engine/march/grids.h"

namespace mw::engine {
namespace {

using namespace test;

bool are_neighbours(Index3 a, Index3 b) {
  return std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1 && std::abs(a.z - b.z) <= 1;
}

Relation by_predecessors(const WindowGrid& grid) {
  const auto count = static_cast<std::size_t>(grid.windows().product());
  Relation out(count, std::vector<bool>(count, false));
  for_each_index(grid.windows(), [&](Index3 w) {
    for (Index3 p : grid.predecessors(w)) {
      EXPECT_LT(raster(p, grid.windows()), raster(w, grid.windows()));
      EXPECT_TRUE((Box3{{0, 0, 0}, grid.windows()}.contains(p)));
      out[raster(w, grid.windows())][raster(p, grid.windows())] = true;
    }
  });
  return out;
}

/// The 13 neighbours earlier in march order.
Relation by_neighbours(const WindowGrid& grid) {
  const auto count = static_cast<std::size_t>(grid.windows().product());
  Relation out(count, std::vector<bool>(count, false));
  for_each_index(grid.windows(), [&](Index3 w) {
    for_each_index(grid.windows(), [&](Index3 v) {
      const std::size_t a = raster(w, grid.windows()), b = raster(v, grid.windows());
      if (b < a && are_neighbours(v, w)) out[a][b] = true;
    });
  });
  return out;
}

TEST(Sec41MarchOrder, PredecessorsAreTheThirteenEarlierNeighboursClosedTransitively) {
  for_each_index(Index3{5, 5, 4}, [](Index3 i) {
    const WindowGrid grid = grid_of(i + Index3{1, 1, 1});
    ASSERT_EQ(grid.windows(), (i + Index3{1, 1, 1}));
    EXPECT_TRUE(transitive_closure(by_predecessors(grid)) ==
                transitive_closure(by_neighbours(grid)));
  });
}

std::vector<WindowGrid> assorted_grids() {
  std::vector<WindowGrid> out;
  for (int window : {2, 4, 6, 16}) {
    for (const Index3 shape : {Index3{1, 1, 1}, {2, 3, 4}, {7, 9, 5}, {16, 17, 15}, {1, 20, 3}}) {
      out.emplace_back(shape, window);
    }
  }
  return out;
}

TEST(WindowGrid, BlocksTileTheVolume) {
  for (const WindowGrid& grid : assorted_grids()) {
    std::vector<int> covered(static_cast<std::size_t>(grid.volume().product()), 0);
    for_each_index(grid.blocks(), [&](Index3 b) {
      const Box3 box = grid.block_box(b);
      EXPECT_GT(box.voxels(), 0);
      for_each_index(box.shape(), [&](Index3 v) { ++covered[raster(box.lo + v, grid.volume())]; });
    });
    EXPECT_EQ(covered, std::vector<int>(covered.size(), 1));
  }
}

/// Windows are at most 2 x 2 x 2 blocks, in raster order, and together cover all.
TEST(WindowGrid, WindowsCoverTheBlocks) {
  for (const WindowGrid& grid : assorted_grids()) {
    std::set<std::size_t> covered;
    for_each_index(grid.windows(), [&](Index3 w) {
      std::size_t last = 0;
      const auto blocks = grid.blocks_of(w);
      const auto along = [](std::int64_t count) { return std::min<std::int64_t>(count, 2); };
      const Index3 all = grid.blocks();
      EXPECT_EQ(blocks.size(),
                static_cast<std::size_t>(along(all.x) * along(all.y) * along(all.z)));
      for (Index3 b : blocks) {
        EXPECT_TRUE((Box3{w, w + Index3{2, 2, 2}}.contains(b)));
        EXPECT_TRUE((Box3{{0, 0, 0}, all}.contains(b)));
        const std::size_t at = raster(b, all);
        EXPECT_TRUE(covered.empty() || b == blocks.front() || at > last);
        last = at;
        covered.insert(at);
      }
    });
    EXPECT_EQ(covered.size(), static_cast<std::size_t>(grid.blocks().product()));
  }
}

/// True when 4 * box, in lattice units, holds the sum of four positions; half-open.
bool holds(const Box3& box, const std::array<std::int64_t, 3>& sum) {
  const std::int64_t unit = 4 * kUnitsPerVoxel;
  return sum[0] >= box.lo.x * unit && sum[0] < box.hi.x * unit && sum[1] >= box.lo.y * unit &&
         sum[1] < box.hi.y * unit && sum[2] >= box.lo.z * unit && sum[2] < box.hi.z * unit;
}

std::int64_t gap(std::int64_t lo, std::int64_t hi, std::int64_t sum) {
  const std::int64_t unit = 4 * kUnitsPerVoxel;
  if (sum < lo * unit) return lo * unit - sum;
  return sum < hi * unit ? 0 : sum - hi * unit + 1;
}

/// Per axis: how far the barycentre is from the block.
std::array<std::int64_t, 3> distance(const Box3& box, const std::array<std::int64_t, 3>& sum) {
  return {gap(box.lo.x, box.hi.x, sum[0]), gap(box.lo.y, box.hi.y, sum[1]),
          gap(box.lo.z, box.hi.z, sum[2])};
}

TEST(Sec42Owner, IsTheBlockOfTheBarycentreOrTheNearestOfTheWindow) {
  std::mt19937 random(851);
  int inside = 0, outside = 0;
  for (const WindowGrid& grid : assorted_grids()) {
    for_each_index(grid.windows(), [&](Index3 w) {
      const auto blocks = grid.blocks_of(w);
      for (int i = 0; i < 40; ++i) {
        // Inside the volume, every second time exactly on a voxel plane.
        const auto along = [&](std::int64_t voxels) {
          const auto sum = static_cast<std::int64_t>(random()) % (voxels * 4 * kUnitsPerVoxel);
          return i % 2 == 0 ? sum : sum / (4 * kUnitsPerVoxel) * (4 * kUnitsPerVoxel);
        };
        const std::array<std::int64_t, 3> sum{along(grid.volume().x), along(grid.volume().y),
                                              along(grid.volume().z)};
        const Index3 owner = grid.owner(w, sum);
        ASSERT_EQ(std::count(blocks.begin(), blocks.end(), owner), 1);
        const auto away = distance(grid.block_box(owner), sum);
        bool any = false;
        for (Index3 b : blocks) {
          any |= holds(grid.block_box(b), sum);
          const auto other = distance(grid.block_box(b), sum);
          for (std::size_t k = 0; k < 3; ++k) ASSERT_LE(away[k], other[k]);
        }
        ASSERT_EQ(holds(grid.block_box(owner), sum), any);
        (any ? inside : outside) += 1;
      }
    });
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

constexpr std::int64_t kBrick = 16;

/// Bricks in a row, with faces in the first.
BoundaryFaces row_of(std::int64_t bricks, std::uint16_t faces) {
  BoundaryFaces out({bricks * kBrick, kBrick, kBrick});
  out.add(0, {&faces, 1});
  return out;
}

TEST(InnerQuality, OneLabelIsSparse) {
  EXPECT_EQ(inner_quality_for(row_of(1, 0)), kSparseInnerQuality);
}

TEST(InnerQuality, FacesEverywhereAreDense) {
  EXPECT_EQ(inner_quality_for(row_of(1, 1)), kInnerQuality);
}

TEST(InnerQuality, EmptyBricksDecide) {
  EXPECT_EQ(inner_quality_for(row_of(11, 159)), kSparseInnerQuality);
  EXPECT_EQ(inner_quality_for(row_of(11, 160)), kInnerQuality);
}

/// Bricks that the volume cuts short count as well.
TEST(InnerQuality, PartsOfBricksAreBricks) {
  BoundaryFaces faces({2 * kBrick + 1, 1, 1});
  const std::uint16_t few = 31, many = 32;
  faces.add(2, {&few, 1});
  EXPECT_EQ(inner_quality_for(faces), kSparseInnerQuality);
  faces.add(2, {&many, 1});
  EXPECT_EQ(inner_quality_for(faces), kInnerQuality);
}

/// Grids that begin at any block.
template <typename Check>
void for_grids_from_anywhere(Check check) {
  for (int window : {2, 4, 6}) {
    for (const Index3 shape : {Index3{7, 9, 5}, {6, 8, 4}, {3, 10, 12}}) {
      const Index3 blocks = WindowGrid(shape, window).blocks();
      for_each_index(blocks, [&](Index3 first) { check(WindowGrid(shape, window, first)); });
    }
  }
}

Index3 in_cell(Index3 v, Index3 shape) {
  return {v.x % shape.x, v.y % shape.y, v.z % shape.z};
}

TEST(WindowGrid, BlocksFromAnywhereTileTheVolumeAndItsNextCopy) {
  for_grids_from_anywhere([](const WindowGrid& grid) {
    const WindowGrid plain(grid.volume(), static_cast<int>(2 * grid.block_edge()));
    std::set<std::size_t> covered;
    for_each_index(grid.blocks(), [&](Index3 b) {
      ASSERT_EQ(grid.in_grid(grid.in_volume(b)), b);
      const Box3 box = grid.block_box(b), in_volume = plain.block_box(grid.in_volume(b));
      ASSERT_EQ(box.lo - grid.beyond(b), in_volume.lo);
      ASSERT_EQ(box.hi - grid.beyond(b), in_volume.hi);
      for_each_index(box, [&](Index3 v) {
        ASSERT_TRUE(covered.insert(raster(in_cell(v, grid.volume()), grid.volume())).second);
      });
      if (b.x + 1 < grid.blocks().x) {
        ASSERT_EQ(grid.block_box(b + Index3{1, 0, 0}).lo.x, box.hi.x) << "blocks follow each other";
      }
    });
    ASSERT_EQ(covered.size(), static_cast<std::size_t>(grid.volume().product()));
  });
}

TEST(WindowGrid, OwnersFromAnywhereHoldTheBarycentre) {
  for_grids_from_anywhere([](const WindowGrid& grid) {
    for_each_index(grid.windows(), [&](Index3 w) {
      const Box3 box = grid.window_box(w);
      for_each_index(box, [&](Index3 v) {
        const auto sum = [](std::int64_t voxel) { return 4 * voxel * kUnitsPerVoxel + 2048; };
        const Index3 owner = grid.owner(w, {sum(v.x), sum(v.y), sum(v.z)});
        ASSERT_TRUE(grid.block_box(owner).contains(v));
      });
    });
  });
}

}  // namespace
}  // namespace mw::engine
