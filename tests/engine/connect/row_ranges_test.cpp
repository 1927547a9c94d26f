// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets by ranges of rows, against a map of all of them.
#include "engine/connect/row_ranges.h"

#include <map>
#include <random>
#include <set>

#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using mw::test::TempFolder;

io::TetRows random_rows(std::mt19937& random, std::uint64_t rows) {
  std::uniform_int_distribution<std::uint64_t> any(0, rows - 1);
  return {any(random), any(random), any(random), any(random)};
}

TEST(RowRanges, BringTogetherTheTetsThatHaveARowOfARange) {
  const TempFolder folder;
  std::mt19937 random(2101);
  // Few rows make each range a long one; of many most ranges have no tet.
  for (const std::uint64_t rows : {1UL, 900UL, 5'000UL, 300'000UL, 1UL << 40U}) {
    for (const std::size_t bytes : {100UL, 3'000UL, 1UL << 20U}) {
      std::map<std::uint64_t, std::set<std::uint64_t>> expected;
      RowRanges ranges(folder.path(), bytes);
      for (std::uint64_t tet = random() % 1000, last = tet + random() % 3000; tet < last;) {
        std::vector<RangeTet> found;
        for (std::uint64_t some = random() % 50; some > 0; --some, tet += 1 + random() % 3) {
          const io::TetRows corners = random_rows(random, rows);
          for (const std::uint64_t row : corners) expected[row / kRowsARange].insert(tet);
          add_ranges(tet, corners, found);
        }
        ranges.add(found);
      }
      for (const auto& [range, tets] : expected) {
        const std::optional<RangeTets> next = ranges.next();
        ASSERT_TRUE(next.has_value());
        EXPECT_EQ(next->range, range);
        EXPECT_EQ(next->tets, std::vector(tets.begin(), tets.end()));
      }
      EXPECT_FALSE(ranges.next().has_value());
    }
  }
}

TEST(RowRanges, TetsAreReadWhereverTheyAre) {
  const TempFolder folder;
  std::mt19937 random(2102);
  constexpr std::size_t kTets = 20'000;
  std::vector<io::TetRows> tets;
  std::vector<RawLabel> labels;
  for (std::size_t t = 0; t < kTets; ++t) {
    tets.push_back(random_rows(random, 1000));
    labels.push_back(random());
  }
  io::ScratchMesh mesh(folder.path());
  mesh.add_tets(tets, labels);
  mesh.settle();
  for (const std::uint64_t most_step : {1U, 2U, 60U, 9'000U}) {
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t t = random() % most_step; t < kTets; t += 1 + random() % most_step) {
      numbers.push_back(t);
    }
    std::vector<io::TetRows> found(numbers.size());
    std::vector<RawLabel> found_labels(numbers.size());
    read_tets(mesh, numbers, found, found_labels);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ASSERT_EQ(found[i], tets[numbers[i]]);
      ASSERT_EQ(found_labels[i], labels[numbers[i]]);
    }
  }
}

}  // namespace
}  // namespace mw::engine
