// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks come out of a window's pack as they went in, or not at all.
#include "engine/keep/window_pack.h"

#include <gtest/gtest.h>

#include "engine/keep/kept_block.h"
#include "engine/store/codec/byte_codes.h"
#include "io/file/errors.h"
#include "tests/engine/store/random_blocks.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;

using Blocks = std::vector<std::vector<std::byte>>;

/// Some of the tets of a mesh with their vertices and samples.
BlockMesh part_of(const BlockMesh& mesh, std::mt19937& random) {
  constexpr std::uint32_t kUnused = ~0U;
  BlockMesh out;
  for (const BlockTet& t : mesh.tets) {
    if (random() % 2 == 0) out.tets.push_back(t);
  }
  std::vector<std::uint32_t> rows(mesh.vertices.size(), kUnused);
  for (const BlockTet& t : out.tets) {
    for (std::uint32_t v : t.vertices) rows[v] = 0;
  }
  for (std::size_t v = 0; v < rows.size(); ++v) {
    if (rows[v] == kUnused) continue;
    rows[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(mesh.vertices[v]);
  }
  for (BlockTet& t : out.tets) {
    for (std::uint32_t& v : t.vertices) v = rows[v];
  }
  for (BlockSample s : mesh.samples) {
    const auto is_here = [&](std::uint32_t v) { return rows[v] != kUnused; };
    if (!std::all_of(s.triangle.begin(), s.triangle.end(), is_here)) continue;
    for (std::uint32_t& v : s.triangle) v = rows[v];
    out.samples.push_back(s);
  }
  return out;
}

/// Eight blocks that share vertices, and now and then one that has other vertices of these ids.
Blocks random_window(std::mt19937& random, std::size_t size) {
  const BlockMesh whole = test::random_block(random, size);
  const io::LabelTable table(std::vector<RawLabel>{1}, false);
  Blocks out;
  for (std::int64_t i = 0; i < 8; ++i) {
    BlockMesh mesh = part_of(whole, random);
    if (random() % 8 == 0) {
      for (BlockVertex& v : mesh.vertices) v.quadric = test::random_quadric(random);
    }
    for (BlockTet& t : mesh.tets) t.label = 0;
    for (BlockSample& s : mesh.samples) s.side = 0;
    std::sort(mesh.samples.begin(), mesh.samples.end());
    out.push_back(to_kept(encode_block({0, {i, 0, 0}}, mesh), LabelKeys(table)));
  }
  return out;
}

TEST(WindowPack, GivesBackEachBlock) {
  std::mt19937 random(3521);
  io::ZstdPacker packer(1);
  for (int i = 0; i < 60; ++i) {
    const Blocks blocks = random_window(random, i < 40 ? 30 : 2000);
    const std::vector<std::byte> packed = pack_blocks(blocks, packer);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      ASSERT_EQ(unpack_block(packed, b), blocks[b]) << "window " << i << ", block " << b;
    }
  }
}

/// Blocks as they are make one frame that is larger.
TEST(WindowPack, PacksBetterByColumns) {
  std::mt19937 random(3522);
  io::ZstdPacker packer(1);
  const Blocks blocks = random_window(random, 4000);
  std::vector<std::byte> all, plain;
  for (const std::vector<std::byte>& block : blocks) {
    all.insert(all.end(), block.begin(), block.end());
  }
  packer.append(all, plain);
  EXPECT_LT(1.1 * static_cast<double>(pack_blocks(blocks, packer).size()),
            static_cast<double>(plain.size()));
}

TEST(WindowPack, RefusesWhatIsDamaged) {
  std::mt19937 random(3523);
  io::ZstdPacker packer(1);
  const std::vector<std::byte> packed = pack_blocks(random_window(random, 300), packer);
  ASSERT_GT(packed.size(), 1000U);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> damaged = packed;
    if (i % 3 == 0) {
      damaged.resize(below(random, static_cast<std::uint32_t>(packed.size())));
    } else {
      damaged[below(random, static_cast<std::uint32_t>(packed.size()))] ^=
          static_cast<std::byte>(1U << random() % 8);
    }
    EXPECT_THROW(static_cast<void>(unpack_block(damaged, 0)), BadBytes);
  }
}

}  // namespace
}  // namespace mw::engine
