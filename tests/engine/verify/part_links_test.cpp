// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts that share items are one, in memory and beyond it.
#include "engine/verify/part_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "kernels/audit/topology/parts_union.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

constexpr std::uint32_t kParts = 40;
constexpr std::size_t kNoMemory = 0;
constexpr std::size_t kAmple = 1 << 20U;

struct ItemRun {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  std::uint32_t part = 0;
};

std::vector<ItemRun> random_runs(std::mt19937_64& random, std::size_t count) {
  std::vector<ItemRun> out(count);
  for (ItemRun& run : out)
    run = {random() % 400, 1 + random() % 4, static_cast<std::uint32_t>(random() % kParts)};
  return out;
}

/// Components of one label whose parts these runs join.
std::int64_t components(const std::vector<ItemRun>& runs, std::size_t memory_bytes) {
  const test::TempFolder folder;
  PartLinks links(folder.path(), memory_bytes);
  for (const ItemRun& run : runs) links.add(run.first, run.count, run.part);
  audit::PartsUnion parts(1);
  audit::PartsPiece piece;
  piece.part_class.assign(kParts, 0);
  parts.add(std::move(piece));
  links.unite(parts);
  return parts.betti_of_volume()[0].open.b0;
}

bool share_an_item(const ItemRun& a, const ItemRun& b) {
  return a.first < b.first + b.count && b.first < a.first + a.count;
}

/// The reference: counts components by comparing all runs with all.
std::int64_t components_by_force(const std::vector<ItemRun>& runs) {
  std::vector<std::uint32_t> name(kParts);
  for (std::uint32_t part = 0; part < kParts; ++part) name[part] = part;
  for (const ItemRun& a : runs) {
    for (const ItemRun& b : runs) {
      const std::uint32_t old = name[a.part];
      const std::uint32_t other = name[b.part];
      if (share_an_item(a, b)) std::replace(name.begin(), name.end(), old, other);
    }
  }
  return std::ssize(std::set<std::uint32_t>(name.begin(), name.end()));
}

TEST(PartLinks, JoinPartsThatShareItemsWhateverTheMemory) {
  std::mt19937_64 random(1);
  std::set<std::int64_t> seen;
  for (int round = 0; round < 200; ++round) {
    const std::vector<ItemRun> runs = random_runs(random, random() % 60);
    const std::int64_t expected = components_by_force(runs);
    EXPECT_EQ(components(runs, kAmple), expected) << round;
    EXPECT_EQ(components(runs, kNoMemory), expected) << round;
    seen.insert(expected);
  }
  EXPECT_GT(seen.size(), 10U);
}

TEST(PartLinks, NeighboursAreNotJoined) {
  for (const std::size_t memory : {kNoMemory, kAmple}) {
    EXPECT_EQ(components({{0, 5, 0}, {5, 5, 1}, {10, 1, 2}}, memory), kParts);
    EXPECT_EQ(components({{0, 6, 0}, {5, 5, 1}, {9, 1, 2}}, memory), kParts - 2);
  }
}

}  // namespace
}  // namespace mw::engine
