// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers and hashes of chunks are those that others have published.
#include "io/volume/precomputed/sharding.h"

#include "tests/io/volume/precomputed/precomputed_sample.h"

namespace mw::io {
namespace {

/// SMHasher's verification of a hash of 128 bits.
std::uint32_t verification() {
  std::string key, hashes;
  const auto hash = [](const std::string& bytes, std::uint32_t seed) {
    std::string out;
    for (const std::uint32_t part : murmur_reference(bytes, seed))
      out += number_bytes(part, 4, false);
    return out;
  };
  for (std::uint32_t i = 0; i < 256; ++i) {
    hashes += hash(key, 256 - i);
    key.push_back(static_cast<char>(i));
  }
  return murmur_reference(hashes, 0)[0];
}

TEST(PrecomputedHash, IsThatOfSmHasherAndTensorStore) {
  ASSERT_EQ(verification(), 0xb3ece62aU);  // SMHasher, "Murmur3C"
  EXPECT_EQ(murmur_hash(0), 0x4772b084e028ae41U);
  EXPECT_EQ(murmur_hash(1), 0xe8bd67d616d4ce9aU);
  EXPECT_EQ(murmur_hash(42), 0xc20b94f95119f47aU);
  std::mt19937_64 random(1);
  for (int round = 0; round < 1000; ++round) {
    const std::uint64_t key = random() >> random() % 64;
    const auto h = murmur_reference(number_bytes(key, 8, false), 0);
    ASSERT_EQ(murmur_hash(key), h[0] | std::uint64_t{h[1]} << 32);
  }
}

TEST(PrecomputedMorton, IsThatOfTheDescription) {
  // Of a volume of 42943 x 56068 x 82276 voxels in chunks of 64, by hand.
  EXPECT_EQ(morton_code({335, 438, 1024}, {671, 877, 1286}), 0x434522d9U);
  Random random(2);
  for (int round = 0; round < 2000; ++round) {
    const Index3 grid = pick_shape(random, std::int64_t{1} << pick(random, 0, 20));
    const Index3 cell{pick(random, 0, grid.x - 1), pick(random, 0, grid.y - 1),
                      pick(random, 0, grid.z - 1)};
    ASSERT_EQ(morton_code(cell, grid), morton_reference(cell, grid));
  }
}

TEST(PrecomputedMorton, DiffersForAllCells) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    const Index3 grid = pick_shape(random, 9);
    std::set<std::uint64_t> codes;
    each_chunk(grid, {1, 1, 1},
               [&](Index3 cell, const Box3&) { codes.insert(morton_code(cell, grid)); });
    ASSERT_EQ(codes.size(), static_cast<std::size_t>(grid.product()));
  }
}

TEST(PrecomputedSharding, PlacesAndNames) {
  // The same volume: preshift 9, 6 bits of minishards, 16 of shards.
  const Sharding sharding{.preshift_bits = 9, .minishard_bits = 6, .shard_bits = 16};
  const ShardPosition index = position_of(sharding, 0x434522d9U);
  EXPECT_EQ(index.shard, 0x868aU);
  EXPECT_EQ(index.minishard, 0x11U);
  EXPECT_EQ(shard_file_name(sharding, index.shard), "868a.shard");
  EXPECT_EQ(shard_file_name({.shard_bits = 9}, 0xb), "00b.shard");
  EXPECT_EQ(shard_file_name({.shard_bits = 0}, 0), "0.shard");
  EXPECT_EQ(shard_file_name({.shard_bits = 64}, ~std::uint64_t{0}), "ffffffffffffffff.shard");
  const ShardPosition all = position_of({.preshift_bits = 64, .shard_bits = 64}, ~std::uint64_t{0});
  EXPECT_EQ(all.shard, 0U);
  EXPECT_EQ(position_of({.shard_bits = 64}, ~std::uint64_t{0}).shard, ~std::uint64_t{0});
}

TEST(PrecomputedSharding, NoMinishardHoldsMoreThanItsBound) {
  Random random(4);
  for (int round = 0; round < 100; ++round) {
    const Index3 grid = pick_shape(random, 14);
    const Sharding sharding{.hashed = round % 2 == 0,
                            .preshift_bits = static_cast<int>(pick(random, 0, 12)),
                            .minishard_bits = static_cast<int>(pick(random, 0, 5)),
                            .shard_bits = static_cast<int>(pick(random, 0, 5))};
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint64_t> held;
    each_chunk(grid, {1, 1, 1}, [&](Index3 cell, const Box3&) {
      const ShardPosition index = position_of(sharding, morton_code(cell, grid));
      ++held[{index.shard, index.minishard}];
    });
    for (const auto& [index, count] : held) ASSERT_LE(count, max_in_minishard(sharding, grid));
  }
}

TEST(PrecomputedSharding, EntriesOfMinishardsLieInTheFile) {
  const auto parse = [](const std::vector<std::uint64_t>& numbers) {
    std::string bytes;
    for (const std::uint64_t n : numbers) bytes += number_bytes(n, 8, false);
    return parse_minishard_index(std::as_bytes(std::span(bytes)), 100, "m");
  };
  const auto two = parse({5, 3, 10, 20, 30, 40});  // rows of numbers, gaps and sizes
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].chunk, 5U);
  EXPECT_EQ(two[0].offset, 10U);
  EXPECT_EQ(two[0].size, 30U);
  EXPECT_EQ(two[1].chunk, 8U);
  EXPECT_EQ(two[1].offset, 60U);
  EXPECT_EQ(two[1].size, 40U);
  EXPECT_TRUE(parse({}).empty());
  const std::uint64_t back = ~std::uint64_t{0};  // sums of it wrap
  for (const std::vector<std::uint64_t>& numbers :
       {std::vector<std::uint64_t>{5, 3, 10, 20, 30, 41},
        {5, 3, 10, 21, 30, 40},
        {5, 10, back},
        {5, back, 10},
        {5, 101, 0},
        {5, 3, 10, back, 30, 1},
        {5, 3, 10, back - 5, 30, 10}}) {
    expect_error(ErrorKind::kInput, {"m: minishard index", "beyond the end"},
                 [&] { static_cast<void>(parse(numbers)); });
  }
  expect_error(ErrorKind::kInput, {"minishard index", "multiple of 24"}, [&] {
    static_cast<void>(parse({1, 2}));
  });
}

}  // namespace
}  // namespace mw::io
