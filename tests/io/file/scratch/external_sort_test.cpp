// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorting with little memory gives what sorting with much does.
#include "io/file/scratch/external_sort.h"

#include <random>

#include "tests/io/test_files.h"

namespace mw::io {
namespace {

TEST(ExternalSort, IsStdSortForEveryBudget) {
  const TempDir dir;
  std::mt19937_64 random(341);
  for (const std::size_t count : {0U, 1U, 2U, 3U, 100U, 4096U, 20000U}) {
    std::vector<std::array<std::uint64_t, 2>> records;
    for (std::size_t i = 0; i < count; ++i) records.push_back({random() % (count + 1), random()});
    for (const std::size_t memory : {0U, 100U, 3000U, 65536U, 1U << 24}) {
      ExternalSort<2> sort(dir.path(), memory);
      for (const auto& record : records) sort.add(record);
      std::vector<std::array<std::uint64_t, 2>> sorted;
      sort.each([&](const auto& record) { sorted.push_back(record); });
      auto expected = records;
      std::sort(expected.begin(), expected.end());
      EXPECT_TRUE(sorted == expected) << count << " records, " << memory << " bytes";
    }
  }
}

TEST(ScratchFile, GivesBackWhatWasAppendedAndLeavesNoName) {
  const TempDir dir;
  ScratchFile file(dir.path());
  std::string all;
  for (std::size_t i = 0; i < 300; ++i) {
    const std::string piece(i * 17 % 5000 + (i == 200 ? 1U << 20 : 0U),
                            static_cast<char>('a' + i % 26));
    file.append(piece);
    all += piece;
    std::string last(std::min<std::size_t>(all.size(), 9000), '\0');
    file.read_at(all.size() - last.size(), std::as_writable_bytes(std::span(last)));
    EXPECT_TRUE(all.ends_with(last));
  }
  EXPECT_EQ(file.size(), all.size());
  std::string whole(all.size(), '\0');
  file.read_at(0, std::as_writable_bytes(std::span(whole)));
  EXPECT_TRUE(whole == all);
  EXPECT_EQ(dir.entries(), 0U);
  expect_error(ErrorKind::kUsage, {"nowhere"}, [&] { ScratchFile gone(dir.path() / "nowhere"); });
}

}  // namespace
}  // namespace mw::io
