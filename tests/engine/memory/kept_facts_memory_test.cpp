// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 6, of what is kept: a folder that shrinks takes no record of each window into memory.
#include "engine/keep/kept_facts.h"

#include "tests/engine/memory/counted_memory.h"
#include "tests/engine/store/layouts.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using namespace test;

constexpr GroupCommit kGroup{.windows = 64, .age = std::chrono::hours(1)};

/// Adds what windows left; the later their turn, the more.
void add_all(KeptFacts& facts, const RunLayout& layout) {
  for (std::uint64_t window = 0; window < layout.windows(); ++window) {
    WindowRecord record{.window = window, .input = {}, .extent = {}, .blocks = {}};
    const WindowKey key = layout.window_key(window);
    record.blocks.resize(layout.grid(key.march).blocks_of(key.window).size());
    facts.add(record, std::vector<std::byte>(100 + window % 7 * 500));
  }
}

TEST(Promise6BoundedMemory, OfKeptFactsThatShrink) {
  const RunLayout layout({grid_of({24, 24, 12})}, Order::kColour);
  const mw::test::TempFolder folder;
  KeepFolder kept(folder.path() / "kept", KeepUse::kGoOn);
  KeptFacts facts(kept, layout, kGroup);
  add_all(facts, layout);
  facts.save();
  const std::uint64_t before = mw::test::allocated_bytes();
  mw::test::start_peak();
  facts.shrink_to(kept.bytes() / 2);
  facts.finish();
  const std::uint64_t taken = mw::test::peak_allocated_bytes() - before;
  EXPECT_TRUE(facts.has_dropped());
  // Less than a third of a record: a place in a list of windows, and what it takes to note a gap.
  EXPECT_LE(taken, 150 * layout.windows() + (256 << 10));
}

}  // namespace
}  // namespace mw::engine
