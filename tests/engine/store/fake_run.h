// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A run whose windows write arbitrary blocks, each a function of what it took.
#pragma once

#include "engine/march/march.h"
#include "engine/store/run_store.h"
#include "kernels/mesh/block_mesh.h"
#include "tests/engine/store/random_blocks.h"

namespace mw::engine::test {

[[nodiscard]] inline RunLayout fake_layout(Index3 volume = {13, 9, 8}, int marches = 2) {
  std::vector<WindowGrid> grids;
  for (int i = 0, window = 4; i < marches; ++i, window *= 2) grids.emplace_back(volume, window);
  return RunLayout(std::move(grids));
}

/// Answers that every block stays in this process, so nothing is ever sent.
class KeepsAll : public BlockRouter {
 public:
  [[nodiscard]] bool stays(const BlockVersion& /*version*/) const override { return true; }
  void send(const BlockVersion& /*version*/, BlockPin /*block*/) override {}
  void committed(std::span<const BlockVersion> /*versions*/) override {}
  [[nodiscard]] bool is_carrying() const override { return false; }
};

/// What a window writes: its own place and the content of all it took decide.
inline std::vector<BlockMesh> fake_work(const RunLayout& layout, const WindowKey& key,
                                        const std::vector<std::optional<BlockMesh>>& taken) {
  std::uint32_t seed = static_cast<std::uint32_t>(layout.window(key));
  for (const auto& block : taken) {
    const auto bytes = encode_block({}, block.value_or(BlockMesh{}));
    seed = seed * 31 + io::checksum(bytes);
  }
  std::mt19937 random(seed);
  std::vector<BlockMesh> out;
  for (Index3 block : layout.grid(key.march).blocks_of(key.window)) {
    out.push_back(random_block(random, 60));
    // Blocks are merged by vertex ids, so two blocks must not give different vertices one id.
    const std::uint64_t base = layout.slot({key.march, block}) << 32;
    for (std::size_t i = 0; i < out.back().vertices.size(); ++i) {
      out.back().vertices[i].id = base + i;
    }
  }
  return out;
}

/// Does the windows that are not done, in any order that predecessors allow, and calls `after`
/// behind each.
inline void fake_run(
    const RunLayout& layout, RunStore& store, std::mt19937& random,
    const std::function<void()>& after = [] {}) {
  for (std::uint32_t m = 0; m < layout.marches(); ++m) {
    BlockStore& blocks = store.march(m);
    const PickReady any = [&](std::span<const Index3> ready) { return random() % ready.size(); };
    const VisitWindow visit = [&](Index3 w) {
      if (blocks.is_done(w)) return;
      blocks.commit(w, fake_work(layout, {m, w}, blocks.take(w)));
      after();
    };
    march_by_choice(WindowOrder(layout.grid(m), Order::kRaster), visit, any);
  }
}

/// The blocks of the last march, encoded.
using FinalBytes = std::vector<std::vector<std::byte>>;

[[nodiscard]] inline FinalBytes final_bytes(const RunLayout& layout, RunStore& store) {
  FinalBytes out;
  const std::uint32_t last = layout.marches() - 1;
  for_each_index(layout.grid(last).blocks(), [&](Index3 b) {
    out.push_back(encode_block({last, b}, store.march(last).load(b)));
  });
  return out;
}

/// The reference: makes that run with its blocks in a map, and without a store.
[[nodiscard]] inline FinalBytes reference_run(const RunLayout& layout) {
  std::map<std::uint64_t, BlockMesh> blocks;
  const auto find = [&](const BlockKey& key) -> std::optional<BlockMesh> {
    const auto found = blocks.find(layout.slot(key));
    return found == blocks.end() ? std::nullopt : std::optional(found->second);
  };
  for (std::uint32_t m = 0; m < layout.marches(); ++m) {
    if (m > 0) {
      for_each_index(layout.grid(m).blocks(), [&](Index3 b) {
        std::vector<BlockMesh> parts;
        for (const BlockKey& part : layout.parts({m, b})) parts.push_back(find(part).value());
        blocks[layout.slot({m, b})] = merge_blocks(parts);
      });
    }
    for_each_index(layout.grid(m).windows(), [&](Index3 w) {
      std::vector<std::optional<BlockMesh>> taken;
      const auto keys = layout.grid(m).blocks_of(w);
      for (Index3 b : keys) taken.push_back(find({m, b}));
      const std::vector<BlockMesh> done = fake_work(layout, {m, w}, taken);
      for (std::size_t i = 0; i < keys.size(); ++i) blocks[layout.slot({m, keys[i]})] = done[i];
    });
  }
  FinalBytes out;
  const std::uint32_t last = layout.marches() - 1;
  for_each_index(layout.grid(last).blocks(), [&](Index3 b) {
    out.push_back(encode_block({last, b}, find({last, b}).value()));
  });
  return out;
}

/// Windows that are done have all their predecessors done, and marches end before the next begins.
inline void expect_closed(const RunLayout& layout, RunStore& store) {
  bool all_before = true;
  for (std::uint32_t m = 0; m < layout.marches(); ++m) {
    const BlockStore& blocks = store.march(m);
    bool all = true;
    for_each_index(layout.grid(m).windows(), [&](Index3 w) {
      all = all && blocks.is_done(w);
      if (!blocks.is_done(w)) return;
      EXPECT_TRUE(all_before);
      for (Index3 p : layout.grid(m).predecessors(w)) EXPECT_TRUE(blocks.is_done(p));
    });
    all_before = all;
  }
}

}  // namespace mw::engine::test
