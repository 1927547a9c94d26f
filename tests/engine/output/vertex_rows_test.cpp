// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows of shared vertices: right for any reach, remembered no longer than needed.
#include "engine/output/vertex_rows.h"
#include "tests/engine/output/scattered.h"

namespace mw::engine {
namespace {

using namespace test;

TEST(VertexRows, AreThoseOfAMapOfAllVertices) {
  std::mt19937 random(311);
  for (std::uint32_t i = 0; i < 200 && !HasFailure(); ++i) {
    const Scattered scattered =
        scatter_vertices(random, random_shape(random, 1, 17), i % 5, 1 + i * 5);
    VertexRows rows(uses_of(scattered));
    std::map<VertexId, std::uint64_t> all;
    for_each_index(scattered.grid.blocks(), [&](Index3 b) {
      std::vector<std::uint64_t> expected;
      for (const BlockVertex& v : scattered.at(b)) {
        expected.push_back(all.try_emplace(v.id, all.size()).first->second);
      }
      EXPECT_EQ(rows.assign(b, scattered.at(b)), expected);
    });
    EXPECT_EQ(rows.count(), all.size());
    EXPECT_EQ(rows.remembered(), 0U);
  }
}

/// The bound that the header states, with vertices of homes counted by brute force.
TEST(VertexRows, RememberNoMoreThanThePlanesInReach) {
  std::mt19937 random(312);
  for (std::uint32_t i = 0; i < 100 && !HasFailure(); ++i) {
    const Scattered scattered = scatter_vertices(random, random_shape(random, 1, 17), i % 4, 400);
    const Index3 blocks = scattered.grid.blocks();
    const VertexUses uses = uses_of(scattered);
    std::vector<std::size_t> of_line(static_cast<std::size_t>(blocks.y * blocks.z));
    std::map<VertexId, bool> counted;
    for (const auto& block : scattered.blocks) {
      for (const BlockVertex& v : block) {
        if (!counted.try_emplace(v.id, true).second) continue;
        ++of_line[uses.line(uses.home(v.position))];
      }
    }
    const std::size_t reach = i % 4;
    const std::size_t lines = 2 * reach * (static_cast<std::size_t>(blocks.y) + 1) + 1;
    std::size_t max = 0;
    for (std::size_t first = 0; first < of_line.size(); ++first) {
      std::size_t sum = 0;
      for (std::size_t l = first; l < std::min(first + lines, of_line.size()); ++l) {
        sum += of_line[l];
      }
      max = std::max(max, sum);
    }
    VertexRows rows(uses);
    for_each_index(blocks, [&](Index3 b) { static_cast<void>(rows.assign(b, scattered.at(b))); });
    EXPECT_LE(rows.max_remembered(), max);
    EXPECT_GT(rows.max_remembered(), 0U);
  }
}

TEST(VertexRows, HomeIsTheBlockAroundAPosition) {
  for (const Index3 shape : {Index3{7, 4, 9}, Index3{1, 2, 3}, Index3{12, 1, 5}}) {
    const WindowGrid grid(shape, 6);
    const VertexUses uses(grid);
    for_each_index(shape, [&](Index3 voxel) {
      const auto middle = [](std::int64_t v) {
        return static_cast<std::int32_t>(v * kUnitsPerVoxel + kUnitsPerVoxel / 2);
      };
      const Index3 home = uses.home({middle(voxel.x), middle(voxel.y), middle(voxel.z)});
      EXPECT_TRUE(grid.block_box(home).contains(voxel));
    });
    const auto end = [](std::int64_t v) { return static_cast<std::int32_t>(v * kUnitsPerVoxel); };
    EXPECT_EQ(uses.home({end(shape.x), end(shape.y), end(shape.z)}),
              grid.blocks() - (Index3{1, 1, 1}));
  }
}

}  // namespace
}  // namespace mw::engine
