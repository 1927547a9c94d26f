// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers and hashes of chunks are those that others have published.
#include "io/volume/precomputed/sharding.h"
#include "io/volume/precomputed/open_precomputed.h"
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

// compressed_segmentation gives back what was encoded, and never reads beyond its bytes.

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string words(const std::vector<std::uint32_t>& all) {
  std::string out;
  for (const std::uint32_t word : all) out += number_bytes(word, 4, false);
  return out;
}

TEST(CompressedSegmentation, ByHand) {
  // 3 x 1 x 1 voxels 5, 9, 5 in a block of 4: one bit a voxel, values in word 2, table from word 3.
  const std::string packed = words({1, 3U | 1U << 24, 2, 0b010, 5, 9});
  const SegmentationLayout layout{.shape = {3, 1, 1}, .block = {4, 1, 1}, .type = VoxelType::kU32};
  EXPECT_EQ(unpack_segmentation(bytes_of(packed), layout, "c"), bytes_of(words({5, 9, 5})));
  // The same voxels in 64 bits; the table is the header of the channel and what follows.
  const std::string wide = words({1, 3U | 2U << 24, 2, 0b000100, 5, 6, 9, 0});
  const SegmentationLayout layout64{.shape = {3, 1, 1}, .block = {4, 1, 1}};
  EXPECT_EQ(unpack_segmentation(bytes_of(wide), layout64, "c"),
            bytes_of(words({5, 6, 9, 0, 5, 6})));
}

TEST(CompressedSegmentation, RandomChunksComeBack) {
  Random random(5);
  for (int round = 0; round < 400; ++round) {
    const VoxelType type = round % 2 == 0 ? VoxelType::kU32 : VoxelType::kU64;
    const Index3 shape = pick_shape(random, 17), block = pick_shape(random, 9);
    const auto labels = random_labels(random, shape, type);
    const SegmentationLayout layout{.shape = shape, .block = block, .type = type};
    const std::string packed = encode_segmentation(random, labels, shape, block, byte_size(type));
    ASSERT_LE(packed.size(), max_segmentation_bytes(layout));
    ASSERT_EQ(unpack_segmentation(bytes_of(packed), layout, "chunk"),
              bytes_of(voxel_bytes(labels, type, false)));
  }
}

TEST(CompressedSegmentation, DamageIsNamed) {
  const SegmentationLayout layout{.shape = {3, 1, 1}, .block = {4, 1, 1}, .type = VoxelType::kU32};
  const auto expect = [&](const std::vector<std::uint32_t>& all, const std::string& piece) {
    expect_error(ErrorKind::kInput, {"chunk 7", "compressed_segmentation", piece}, [&] {
      static_cast<void>(unpack_segmentation(bytes_of(words(all)), layout, "chunk 7"));
    });
  };
  expect({}, "truncated");
  expect({1, 3U | 1U << 24}, "truncated");
  expect({2, 3U | 1U << 24, 2, 0b010, 5, 9}, "begins at word 2");
  expect({1, 3U | 3U << 24, 2, 0b010, 5, 9}, "3 bits");
  expect({1, 3U | 64U << 24, 2, 0b010, 5, 9}, "64 bits");
  expect({1, 6U | 1U << 24, 2, 0b010, 5, 9}, "block (0, 0, 0): its table");
  expect({1, 5U | 1U << 24, 2, 0b010, 5, 9}, "place in the table");
  expect({1, 3U | 2U << 24, 2, 0b010000, 5}, "place in the table");
  expect({1, 3U | 1U << 24, 5, 0b010, 5, 9}, "its voxels");
  expect({1, 3U | 1U << 24, 0xffffffffU, 0b010, 5, 9}, "its voxels");
}

TEST(CompressedSegmentation, DamageAnywhereIsReadOrRefused) {
  Random random(6);
  const Index3 shape{9, 5, 4}, block{4, 4, 4};
  const auto labels = random_labels(random, shape, VoxelType::kU64);
  const SegmentationLayout layout{.shape = shape, .block = block};
  const std::string packed = encode_segmentation(random, labels, shape, block, 8);
  int refused = 0;
  const auto read = [&](const std::string& bytes) {
    try {
      EXPECT_EQ(unpack_segmentation(bytes_of(bytes), layout, "c").size(), 8 * labels.size());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      ++refused;
    }
  };
  for (std::size_t at = 0; at < packed.size(); ++at) {
    read(packed.substr(0, at));
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = packed;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << bit));
      read(flipped);
    }
  }
  EXPECT_GT(refused, static_cast<int>(packed.size()) / 2);
}

}  // namespace
}  // namespace mw::io
