// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Kept bytes do not change when other labels come and go.
#include "engine/keep/kept_block.h"

#include <gtest/gtest.h>

#include "engine/store/journal/work_file.h"
#include "tests/engine/store/random_blocks.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;

/// Labels of random numbers, some above 2^63.
std::vector<RawLabel> random_labels(std::mt19937& random, std::size_t count) {
  std::vector<RawLabel> out;
  while (out.size() < count) out.push_back(RawLabel{random()} << 32U | random());
  return out;
}

/// A block of that number of labels, which are dense.
std::pair<BlockMesh, std::size_t> dense_block(std::mt19937& random) {
  BlockMesh mesh = test::random_block(random, 60);
  std::vector<Label> labels;
  for (const BlockTet& t : mesh.tets) labels.push_back(t.label);
  for (const BlockSample& s : mesh.samples) labels.push_back(s.side);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  const auto rank = [&](Label& label) {
    label =
        static_cast<Label>(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin());
  };
  for (BlockTet& t : mesh.tets) rank(t.label);
  for (BlockSample& s : mesh.samples) rank(s.side);
  return {std::move(mesh), std::max<std::size_t>(labels.size(), 1)};
}

BlockMesh relabelled(BlockMesh mesh, const io::LabelTable& from, const io::LabelTable& to) {
  for (BlockTet& t : mesh.tets) t.label = to.dense(from.raw(t.label));
  for (BlockSample& s : mesh.samples) s.side = to.dense(from.raw(s.side));
  return mesh;
}

TEST(KeptBlock, IsTheSameWhateverOtherLabelsThereAre) {
  std::mt19937 random(3511);
  for (int i = 0; i < 60; ++i) {
    const bool is_signed = i % 2 == 0;
    const BlockKey key{below(random, 3), {below(random, 9), below(random, 9), below(random, 9)}};
    const auto [mesh, labels] = dense_block(random);
    std::vector<RawLabel> some = random_labels(random, labels), more = some;
    const std::vector<RawLabel> others = random_labels(random, 1 + below(random, 50));
    more.insert(more.end(), others.begin(), others.end());
    const io::LabelTable table(some, is_signed), wider(more, is_signed);
    const std::vector<std::byte> encoded = encode_block(key, mesh);
    const std::vector<std::byte> kept = to_kept(encoded, LabelKeys(table));
    EXPECT_EQ(from_kept(key, kept, LabelKeys(table)), encoded);
    const std::vector<std::byte> other = encode_block(key, relabelled(mesh, table, wider));
    EXPECT_EQ(to_kept(other, LabelKeys(wider)), kept);
    EXPECT_EQ(from_kept(key, kept, LabelKeys(wider)), other);
  }
}

TEST(KeptBlock, RefusesALabelThatIsGone) {
  std::mt19937 random(3512);
  const BlockKey key{0, {1, 2, 3}};
  BlockMesh mesh;
  while (mesh.tets.empty()) mesh = test::random_block(random, 60);
  for (BlockTet& t : mesh.tets) t.label = 1;
  for (BlockSample& s : mesh.samples) s.side = 1;
  std::sort(mesh.tets.begin(), mesh.tets.end());
  const io::LabelTable table({5, 7}, false), without({5}, false);
  const std::vector<std::byte> kept = to_kept(encode_block(key, mesh), LabelKeys(table));
  EXPECT_THROW((void)from_kept(key, kept, LabelKeys(without)), DamagedWork);
}

}  // namespace
}  // namespace mw::engine
