// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Failed edges are remembered, from both ends, until one of these changes.
#include "kernels/mesh/failed_pairs.h"

#include <gtest/gtest.h>

#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

/// The memo may lose entries, but never has one that was not made.
TEST(FailedPairs, HoldNothingThatWasNotInserted) {
  std::mt19937 random(421);
  const SmallVolume volume = volume_from({6, 6, 6}, 1, [](auto, auto, auto) { return 0; });
  TetMesh mesh = dense_mesh(volume);
  FailedPairs failed(mesh.vertex_count());
  std::set<std::array<std::uint32_t, 4>> inserted;
  const auto entry = [&](LocalVertex p, LocalVertex q) {
    if (p > q) std::swap(p, q);
    return std::array<std::uint32_t, 4>{p, q, mesh.version(p), mesh.version(q)};
  };
  int kept = 0, forgotten_by_moves = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto [p, q] = random_edge(mesh, random);
    if (p == q) continue;
    if (failed.contains(mesh, p, q)) {
      ASSERT_EQ(inserted.count(entry(p, q)), 1U);
      ASSERT_TRUE(failed.contains(mesh, q, p));
      ++kept;
    }
    inserted.insert(entry(p, q));
    failed.insert(mesh, q, p);
    ASSERT_TRUE(failed.contains(mesh, p, q));
    if (i % 5 != 0) continue;
    mesh.move(p, mesh.position(p), mesh.quadric(p));
    ASSERT_FALSE(failed.contains(mesh, p, q));
    ++forgotten_by_moves;
  }
  EXPECT_GT(kept, 500);
  EXPECT_GT(forgotten_by_moves, 500);
}

TEST(FailedPairs, AreOfSomeSizeWhateverTheMesh) {
  const SmallVolume volume = volume_from({1, 1, 1}, 1, [](auto, auto, auto) { return 0; });
  const TetMesh mesh = dense_mesh(volume);
  FailedPairs failed(0);
  failed.insert(mesh, 0, 1);
  EXPECT_TRUE(failed.contains(mesh, 1, 0));
  EXPECT_FALSE(failed.contains(mesh, 0, 2));
}

}  // namespace
}  // namespace mw::test
