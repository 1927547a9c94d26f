// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// compressed_segmentation gives back what was encoded, and never reads beyond its bytes.
#include "io/volume/precomputed/compressed_segmentation.h"

#include "tests/io/volume/precomputed/precomputed_sample.h"

namespace mw::io {
namespace {

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
