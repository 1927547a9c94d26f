// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records that lie packed in a temporary file come back as they were, in any order of the reads.
#include "io/file/scratch/packed_scratch.h"

#include <array>
#include <random>

#include "tests/io/test_files.h"

namespace mw::io {
namespace {

using Record = std::array<std::uint64_t, 5>;

std::vector<Record> random_records(std::mt19937& random, std::size_t count) {
  std::vector<Record> out(count);
  const std::uint64_t below = std::uint64_t{1} << random() % 64U;
  for (Record& record : out) {
    for (std::uint64_t& word : record) word = (std::uint64_t{random()} << 32U | random()) % below;
  }
  return out;
}

TEST(PackedScratch, GivesEachChunkBack) {
  const TempDir dir;
  PackedScratch<Record> file(dir.path());
  std::mt19937 random(1054);
  std::vector<std::vector<Record>> expected;
  std::vector<PackedChunk> chunks;
  for (int i = 0; i < 100; ++i) {
    expected.push_back(random_records(random, 1 + random() % 5000));
    chunks.push_back(file.append(PackedScratch<Record>::pack(expected.back())));
    EXPECT_EQ(chunks.back().records, expected.back().size());
  }
  std::vector<bool> is_there(chunks.size(), true);
  for (int round = 0; round < 400; ++round) {
    const std::size_t i = random() % chunks.size();
    if (!is_there[i]) continue;
    std::vector<Record> found(3);
    file.read(chunks[i], found);
    EXPECT_TRUE(std::ranges::equal(expected[i], std::span(found).subspan(3)));
    is_there[i] = random() % 3 != 0;
    if (!is_there[i]) file.give_up(chunks[i]);
  }
}

TEST(PackedRecords, AreReadInTheirOrder) {
  const TempDir dir;
  std::mt19937 random(1055);
  for (const std::size_t count : std::to_array<std::size_t>({0, 1, 4095, 4096, 4097, 20000})) {
    PackedRecords<Record> file(dir.path());
    const std::vector<Record> expected = random_records(random, count);
    for (const Record& record : expected) file.append(record);
    for (int round = 0; round < 2; ++round) {
      std::vector<Record> found;
      file.each_batch([&](std::span<const Record> batch) {
        EXPECT_FALSE(batch.empty());
        found.insert(found.end(), batch.begin(), batch.end());
      });
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace mw::io
