// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/pieces/pvtu.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/io/mesh/grid_mesh.h"

namespace mw::io {
namespace {

/// Each tet once, pieces of one size give or take a tet, and the same again.
TEST(MeshParts, ShareOutAllTetsEvenly) {
  std::mt19937 random(411);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const auto edge = [&] { return std::uint64_t{1 + random() % 6}; };
    const MeshData mesh = grid_mesh({edge(), edge(), edge()}, 412 + static_cast<unsigned>(i));
    const std::uint64_t tets = mesh.tets.size();
    const std::uint64_t pieces = 1 + random() % std::min<std::uint64_t>(tets, 40);
    const auto parts = mesh_parts(mesh, pieces);
    ASSERT_EQ(parts.size(), pieces);
    std::set<std::uint64_t> all;
    for (const auto& part : parts) {
      EXPECT_TRUE(part.size() == tets / pieces || part.size() == (tets + pieces - 1) / pieces);
      EXPECT_TRUE(std::is_sorted(part.begin(), part.end()));
      all.insert(part.begin(), part.end());
    }
    EXPECT_EQ(all.size(), tets);
    EXPECT_EQ(*all.rbegin(), tets - 1);
    EXPECT_EQ(mesh_parts(mesh, pieces), parts);
  }
  const MeshData cube = grid_mesh({1, 1, 1}, 413);
  EXPECT_EQ(mesh_parts(cube, cube.tets.size()).size(), cube.tets.size());
}

/// Eight pieces of a cube are its octants.
TEST(MeshParts, AreCompact) {
  const MeshData mesh = grid_mesh({8, 8, 8}, 414);
  for (const auto& part : mesh_parts(mesh, 8)) {
    Position lo = mesh.vertices[mesh.tets[part.front()][0]], hi = lo;
    for (const std::uint64_t t : part) {
      for (const std::uint64_t v : mesh.tets[t]) {
        for (std::size_t k = 0; k < 3; ++k) {
          lo[k] = std::min(lo[k], mesh.vertices[v][k]);
          hi[k] = std::max(hi[k], mesh.vertices[v][k]);
        }
      }
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(hi[k] - lo[k], 4);
  }
}

}  // namespace
}  // namespace mw::io
