// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/verify/tile_buckets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/oracle/small_volumes.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using audit::test::below;
using Record = std::array<std::uint32_t, 3>;

/// Some tiles get much at once, which is packed before, and others a few records.
TEST(TileBuckets, GiveRecordsInTheOrderInWhichTheyCame) {
  constexpr std::uint32_t kTiles = 5;
  std::mt19937 random(1093);
  for (const std::uint64_t memory : {1U, 1U << 16U, 1U << 24U}) {
    const ::mw::test::TempFolder folder;
    TileBuckets<Record> buckets(folder.path(), kTiles, memory);
    std::array<std::vector<Record>, kTiles> expected;
    for (std::uint32_t round = 0; round < 60; ++round) {
      TileShares<Record> found;
      const std::uint32_t records = below(random, below(random, 3) == 0 ? 12000 : 300);
      const std::uint32_t one = below(random, kTiles);
      for (std::uint32_t i = 0; i < records; ++i) {
        const std::uint32_t tile = below(random, 8) == 0 ? below(random, kTiles) : one;
        expected[tile].push_back({round, i, below(random, 4)});
        found.add(tile, expected[tile].back());
      }
      if (below(random, 2) == 0) found.pack();
      buckets.add(found);
      expected[one].push_back({round});
      buckets.add(one, expected[one].back());
    }
    for (std::uint32_t tile = 0; tile < kTiles; ++tile) {
      EXPECT_EQ(buckets.count(tile), expected[tile].size());
      std::vector<Record> out;
      buckets.load(tile, out);
      EXPECT_TRUE(out == expected[tile]) << tile;
      out.clear();
      buckets.take(tile, out);
      EXPECT_TRUE(out == expected[tile]) << tile;
      EXPECT_EQ(buckets.count(tile), 0U);
    }
  }
}

}  // namespace
}  // namespace mw::engine
