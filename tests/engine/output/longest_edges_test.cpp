// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/output/block_figures.h"

#include <gtest/gtest.h>

#include <random>

namespace mw::engine {
namespace {

/// Against all pairs of corners of all tets of a label, whatever blocks they come in.
TEST(LongestEdges, AreThoseOfEachLabel) {
  constexpr std::size_t kLabels = 5;
  std::mt19937 random(391);
  std::uniform_real_distribution<double> place(-3, 7);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  LongestEdges edges(kLabels);
  std::vector<double> expected(kLabels, 0.0);
  for (int block = 0; block < 20; ++block) {
    std::vector<io::Position> positions(4 + below(9));
    for (io::Position& p : positions) p = {place(random), place(random), place(random)};
    std::vector<BlockTet> tets(below(6));
    for (BlockTet& tet : tets) {
      tet.label = below(kLabels - 1);  // the last has no tet
      for (auto& v : tet.vertices) v = below(static_cast<std::uint32_t>(positions.size()));
      for (const auto v : tet.vertices) {
        for (const auto w : tet.vertices) {
          const io::Position &a = positions[v], &b = positions[w];
          double& longest = expected[tet.label];
          longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
        }
      }
    }
    edges.add(tets, positions);
  }
  const std::vector<double> lengths = edges.lengths();
  ASSERT_EQ(lengths.size(), kLabels);
  EXPECT_EQ(lengths.back(), 0.0);
  EXPECT_GT(lengths.front(), 0.0);
  for (std::size_t label = 0; label < kLabels; ++label) {
    EXPECT_DOUBLE_EQ(lengths[label], expected[label]);
  }
}

}  // namespace
}  // namespace mw::engine
