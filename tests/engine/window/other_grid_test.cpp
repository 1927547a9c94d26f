// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks in grids that begin elsewhere: the way there and back, and which vertices become one.
#include "engine/window/other_grid.h"

#include "kernels/odt/codt.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::engine {
namespace {

using namespace mw::test;

/// A cell whose start mesh is alike on opposite faces, and its blocks in a grid.
struct Cell {
  explicit Cell(std::mt19937& random)
      : volume(random_volume_of(
            random, random_kind(random),
            {2 * (2 + below(random, 4)), 2 * (2 + below(random, 4)), 2 * (2 + below(random, 4))},
            1 + below(random, 4))),
        plain(volume.shape, 4) {}

  [[nodiscard]] BlockMesh block(Index3 b) const {
    return dense_block(volume, plain.block_box(b), {.with_samples = true});
  }
  [[nodiscard]] WindowGrid from(Index3 first) const { return {volume.shape, 4, first}; }

  SmallVolume volume;
  WindowGrid plain;
};

Index3 any_block(std::mt19937& random, Index3 blocks) {
  const auto any = [&](std::int64_t n) {
    return std::int64_t{below(random, static_cast<std::uint32_t>(n))};
  };
  const auto x = any(blocks.x), y = any(blocks.y), z = any(blocks.z);
  return {x, y, z};
}

TEST(OtherGrid, BlocksComeBackAsTheyWere) {
  std::mt19937 random(871);
  for (int i = 0; i < 60; ++i) {
    const Cell cell(random);
    const WindowGrid one = cell.from(any_block(random, cell.plain.blocks())),
                     other = cell.from(any_block(random, cell.plain.blocks()));
    for_each_index(cell.plain.blocks(), [&](Index3 b) {
      const BlockMesh content = cell.block(b);
      const Index3 in_one = one.in_grid(b), in_other = other.in_grid(b);
      const BlockMesh there = in_other_grid(content, {cell.plain, b}, {one, in_one});
      const BlockMesh beyond = in_other_grid(there, {one, in_one}, {other, in_other});
      EXPECT_TRUE(in_other_grid(beyond, {other, in_other}, {cell.plain, b}) == content);
      EXPECT_TRUE(std::is_sorted(there.tets.begin(), there.tets.end()));
      for (std::size_t v = 1; v < there.vertices.size(); ++v) {
        EXPECT_LT(there.vertices[v - 1].id, there.vertices[v].id);
      }
    });
  }
}

/// In a grid that begins elsewhere one place is one vertex, and one vertex is in one place.
TEST(OtherGrid, PlacesAndVerticesAreTheSame) {
  std::mt19937 random(872);
  int joined = 0;
  for (int i = 0; i < 60; ++i) {
    const Cell cell(random);
    const WindowGrid grid = cell.from(any_block(random, cell.plain.blocks()));
    std::map<std::array<std::int32_t, 3>, VertexId> at;
    std::set<VertexId> ids, before;
    for_each_index(cell.plain.blocks(), [&](Index3 b) {
      const BlockMesh content = cell.block(b);
      for (const BlockVertex& v : content.vertices) before.insert(v.id);
      const BlockMesh there = in_other_grid(content, {cell.plain, b}, {grid, grid.in_grid(b)});
      for (const BlockVertex& v : there.vertices) {
        const std::array<std::int32_t, 3> place{v.position.x, v.position.y, v.position.z};
        EXPECT_EQ(at.try_emplace(place, v.id).first->second, v.id);
        ids.insert(v.id);
      }
    });
    EXPECT_EQ(ids.size(), at.size());
    joined += ids != before ? 1 : 0;
  }
  EXPECT_GT(joined, 30);
}

/// A vertex that a window made is in two places, too, where a tet crosses the plane in which the
/// grid begins: with two blocks along an axis one window sees both.
TEST(OtherGrid, MadeVerticesAtBothEndsAreApart) {
  constexpr std::int32_t kHalf = kUnitsPerVoxel / 2;
  const SteinerIds ids = steiner_ids(7, 20);
  const WindowGrid plain({4, 4, 4}, 4, {0, 0, 0}), grid({4, 4, 4}, 4, {0, 1, 0});
  const BlockVertex low{ids.first, {kHalf, kHalf, kHalf}, {}},
      shared{ids.first + 1, {kHalf, 5 * kHalf, kHalf}, {}};
  const BlockMesh one{{low, shared}, {}, {}}, other{{shared}, {}, {}};
  const Index3 first{0, 0, 0}, second{0, 1, 0};
  const auto there = [&](const BlockMesh& content, Index3 block) {
    return in_other_grid(content, {plain, block}, {grid, grid.in_grid(block)});
  };
  const auto back = [&](const BlockMesh& content, Index3 block) {
    return in_other_grid(content, {grid, grid.in_grid(block)}, {plain, block});
  };
  const BlockMesh moved = there(one, first), stays = there(other, second);
  EXPECT_EQ(stays.vertices.at(0).position.y, 5 * kHalf);
  EXPECT_EQ(moved.vertices.at(1).position.y, 13 * kHalf);
  EXPECT_NE(stays.vertices[0].id, moved.vertices[1].id);
  EXPECT_TRUE(back(moved, first) == one);
  EXPECT_TRUE(back(stays, second) == other);
}

/// Samples keep their place relative to their triangles.
TEST(OtherGrid, SamplesMoveWithTheirTriangles) {
  std::mt19937 random(873);
  std::size_t moved = 0;
  for (int i = 0; i < 40; ++i) {
    const Cell cell(random);
    const WindowGrid grid = cell.from(any_block(random, cell.plain.blocks()));
    const auto tell = [](const BlockMesh& mesh, Index3 back) {
      std::multiset<std::array<std::int64_t, 7>> out;
      for (const BlockSample& s : mesh.samples) {
        const Index3 lower = lower_voxel(s.samples) - back;
        Index3 sum;
        for (const std::uint32_t v : s.triangle) {
          const Point p = mesh.vertices[v].position;
          sum = sum + Index3{p.x, p.y, p.z};
        }
        const std::int64_t thrice = 3 * kUnitsPerVoxel;
        sum = sum - Index3{thrice * back.x, thrice * back.y, thrice * back.z};
        out.insert({lower.x, lower.y, lower.z, std::int64_t{s.side}, sum.x, sum.y, sum.z});
      }
      return out;
    };
    for_each_index(cell.plain.blocks(), [&](Index3 b) {
      const BlockMesh content = cell.block(b);
      const Index3 place = grid.in_grid(b);
      const BlockMesh there = in_other_grid(content, {cell.plain, b}, {grid, place});
      EXPECT_TRUE(tell(there, grid.beyond(place)) == tell(content, {0, 0, 0}));
      moved += grid.beyond(place) == Index3{} ? 0 : content.samples.size();
    });
  }
  EXPECT_GT(moved, 500U);
}

}  // namespace
}  // namespace mw::engine
