// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks come back from bytes bit by bit, and damaged bytes are refused.
#include "engine/store/codec/block_codec.h"

#include <gtest/gtest.h>

#include "kernels/core/error.h"
#include "tests/engine/store/random_blocks.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::engine {
namespace {

using mw::test::random_volume_of;
using mw::test::VolumeKind;
using test::random_block;
using test::repair_head;
using test::same_bits;

constexpr BlockKey kKey{1, {3, 4, 5}};

/// What the bytes decode to; nothing when they are refused, which must name block and reason.
std::optional<BlockMesh> decode_or_refuse(const std::vector<std::byte>& bytes) {
  try {
    return decode_block(kKey, bytes);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(e.what()).find("block (3, 4, 5) of march 2: corrupt: "),
              std::string::npos)
        << e.what();
    return std::nullopt;
  }
}

std::vector<BlockMesh> start_blocks(std::mt19937& random) {
  std::vector<BlockMesh> out;
  for (int i = 0; i < 6; ++i) {
    const auto volume = random_volume_of(random, static_cast<VolumeKind>(i), {8, 8, 8}, 4);
    out.push_back(mw::test::dense_block(volume, {{0, 0, 0}, {4, 8, 8}},
                                        {.with_samples = i % 2 == 0, .weights = {}}));
  }
  return out;
}

TEST(BlockCodec, GivesBackEveryBit) {
  std::mt19937 random(301);
  std::vector<BlockMesh> blocks = start_blocks(random);
  blocks.push_back({});
  for (std::size_t size = 4; size < 200; ++size) blocks.push_back(random_block(random, size));
  for (const BlockMesh& block : blocks) {
    const std::vector<std::byte> bytes = encode_block(kKey, block);
    const BlockMesh back = decode_block(kKey, bytes);
    ASSERT_TRUE(same_bits(block, back));
    ASSERT_EQ(encode_block(kKey, back), bytes);
  }
}

TEST(BlockCodec, IsCompact) {
  std::mt19937 random(302);
  for (const BlockMesh& block : start_blocks(random)) {
    EXPECT_LT(4 * encode_block(kKey, block).size(), memory_bytes(block));
  }
}

TEST(BlockCodec, RefusesTheBytesOfAnotherBlock) {
  std::mt19937 random(303);
  const BlockMesh block = random_block(random, 50);
  for (const BlockKey& other : {BlockKey{0, {3, 4, 5}}, BlockKey{1, {3, 5, 4}}}) {
    EXPECT_FALSE(decode_or_refuse(encode_block(other, block)));
  }
}

TEST(BlockCodec, RefusesEveryTruncation) {
  std::mt19937 random(304);
  const std::vector<std::byte> bytes = encode_block(kKey, random_block(random, 40));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_or_refuse({bytes.begin(), bytes.begin() + static_cast<long>(size)}));
  }
  std::vector<std::byte> longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_or_refuse(longer));
}

TEST(BlockCodec, RefusesEveryChangedByte) {
  std::mt19937 random(305);
  std::vector<std::byte> bytes = encode_block(kKey, random_block(random, 40));
  for (std::byte& byte : bytes) {
    const std::byte kept = byte;
    byte ^= static_cast<std::byte>(1 + random() % 255);
    EXPECT_FALSE(decode_or_refuse(bytes));
    byte = kept;
  }
}

/// With the checksum made right, damage is either refused or another canonical mesh, which has an
/// encoding of its own; it never crashes (run it under sanitizers) and never asks for much memory.
TEST(BlockCodec, SurvivesDamageUnderAGoodChecksum) {
  std::mt19937 random(306);
  int refused = 0, accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::byte> bytes = encode_block(kKey, random_block(random, 12));
    for (std::size_t k = 1 + random() % 3; k > 0; --k) {
      const std::size_t at = 16 + random() % (bytes.size() - 16);
      if (random() % 4 != 0) {
        bytes[at] = static_cast<std::byte>(random());
      } else {
        bytes.erase(bytes.begin() + static_cast<long>(at), bytes.end());
        bytes.resize(17 + random() % 300, static_cast<std::byte>(random()));
      }
    }
    repair_head(bytes);
    const std::optional<BlockMesh> mesh = decode_or_refuse(bytes);
    ++(mesh ? accepted : refused);
    if (!mesh) continue;
    ASSERT_TRUE(same_bits(decode_block(kKey, encode_block(kKey, *mesh)), *mesh));
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace mw::engine
