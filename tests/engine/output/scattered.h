// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Vertices as blocks reference them, without a mesh.
#pragma once

#include "engine/output/vertex_rows.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::engine::test {

using audit::test::below;
using audit::test::random_shape;

/// Vertices anywhere in a volume, each in a few blocks at most `reach` from its home.
struct Scattered {
  WindowGrid grid;
  std::vector<std::vector<BlockVertex>> blocks;  ///< by raster number, ascending by id

  [[nodiscard]] const std::vector<BlockVertex>& at(Index3 block) const {
    return blocks[raster(block, grid.blocks())];
  }
};

inline std::int32_t random_coordinate(std::mt19937& random, std::int64_t voxels) {
  return static_cast<std::int32_t>(
      below(random, static_cast<std::uint32_t>(voxels * kUnitsPerVoxel + 1)));
}

inline Scattered scatter_vertices(std::mt19937& random, Index3 shape, std::uint32_t reach,
                                  std::size_t count) {
  Scattered out{.grid = WindowGrid(shape, 4), .blocks = {}};
  const Index3 blocks = out.grid.blocks();
  out.blocks.resize(static_cast<std::size_t>(blocks.product()));
  const VertexUses homes(out.grid);
  const auto near = [&](std::int64_t home, std::int64_t max) {
    const std::int64_t offset = std::int64_t{below(random, 2 * reach + 1)} - reach;
    return std::clamp<std::int64_t>(home + offset, 0, max - 1);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Point p{random_coordinate(random, shape.x), random_coordinate(random, shape.y),
                  random_coordinate(random, shape.z)};
    // Ids in no order of place, each once.
    const BlockVertex vertex{.id = i * 7919 % count, .position = p, .quadric = {}};
    const Index3 home = homes.home(p);
    std::map<std::size_t, bool> in;
    for (std::uint32_t copies = 1 + below(random, 6); copies > 0; --copies) {
      in[raster({near(home.x, blocks.x), near(home.y, blocks.y), near(home.z, blocks.z)}, blocks)] =
          true;
    }
    for (const auto& [block, unused] : in) out.blocks[block].push_back(vertex);
  }
  for (auto& block : out.blocks) {
    std::sort(block.begin(), block.end(),
              [](const BlockVertex& a, const BlockVertex& b) { return a.id < b.id; });
  }
  return out;
}

inline VertexUses uses_of(const Scattered& scattered) {
  VertexUses uses(scattered.grid);
  for_each_index(scattered.grid.blocks(),
                 [&](Index3 b) { uses.add(b, uses.lines_of(scattered.at(b))); });
  return uses;
}

}  // namespace mw::engine::test
