// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts that come back from a folder, and what goes when it has to become smaller.
#include "engine/keep/kept_facts.h"

#include <fstream>

#include "engine/keep/window_records.h"
#include "engine/store/run_layout.h"
#include "tests/engine/store/layouts.h"
#include "tests/engine/store/work_folder.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;
using namespace test;

using Bytes = std::vector<std::byte>;

RunLayout layout_of(Index3 windows) {
  const WindowGrid first = grid_of(windows);
  return RunLayout({first, WindowGrid(first.volume(), 8)}, Order::kColour);
}

/// Which bytes a window left in a run.
Bytes bytes_of(std::uint64_t window, std::uint32_t run) {
  Bytes out(200 + (window * 977 + run * 331) % 3000);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = static_cast<std::byte>(i * 31 + window + 7 * run);
  }
  return out;
}

/// Adds what some windows left.
void add(KeptFacts& facts, const RunLayout& layout, const std::vector<std::uint64_t>& windows,
         std::uint32_t run) {
  for (const std::uint64_t window : windows) {
    WindowRecord record{.window = window, .input = {}, .extent = {}, .blocks = {}};
    const WindowKey key = layout.window_key(window);
    record.blocks.resize(layout.grid(key.march).blocks_of(key.window).size());
    for (KeptBlock& block : record.blocks) block.is_kept = true;
    facts.add(record, bytes_of(window, run));
  }
}

std::vector<std::uint64_t> all_windows(const RunLayout& layout) {
  std::vector<std::uint64_t> out(layout.windows());
  std::iota(out.begin(), out.end(), std::uint64_t{0});
  return out;
}

/// Expects what a folder holds to be what was added last, or to be given up and said to be.
/// Returns how many windows' bytes were given up.
std::size_t expect_facts(const KeptFacts& facts, const RunLayout& layout,
                         const std::vector<std::uint32_t>& run_of) {
  std::size_t dropped = 0;
  for (std::uint64_t window = 0; window < layout.windows(); ++window) {
    const auto record = facts.of(window);
    if (!record) return ADD_FAILURE() << window, dropped;
    EXPECT_EQ(record->is_dropped, facts.is_dropped(window));
    EXPECT_EQ(record->is_dropped, record->extent.size == 0);
    for (const KeptBlock& block : record->blocks) EXPECT_EQ(block.is_kept, !record->is_dropped);
    if (record->is_dropped) {
      EXPECT_FALSE(leaves_final_block(layout, layout.window_key(window)));
      ++dropped;
      continue;
    }
    facts.read(record->extent, [&](std::span<const std::byte> bytes) {
      EXPECT_EQ(Bytes(bytes.begin(), bytes.end()), bytes_of(window, run_of[window]));
    });
  }
  return dropped;
}

class KeptFactsTest : public FolderTest {
 protected:
  [[nodiscard]] KeepFolder open() const { return {folder() / "kept", KeepUse::kGoOn}; }
};

TEST_F(KeptFactsTest, ShrinkToWhatIsAskedAndGiveUpWhatIsFarFromTheLastVisits) {
  std::mt19937 random(72);
  const RunLayout layout = layout_of({6, 5, 4});
  for (int i = 0; i < 10; ++i) {
    std::vector<std::uint32_t> run_of(layout.windows(), 1);
    std::filesystem::remove_all(folder() / "kept");
    {
      KeepFolder folder = open();
      folder.settle("window = 8\n");
      KeptFacts facts(folder, layout, {.windows = 1 + below(random, 40)});
      add(facts, layout, all_windows(layout), 1);
      facts.finish();
    }
    KeepFolder folder = open();
    const std::uint64_t limit = folder.bytes() * (30 + below(random, 60)) / 100;
    {
      KeptFacts facts(folder, layout, {});
      std::vector<std::uint64_t> edited{below(random, 20), 40 + below(random, 20)};
      add(facts, layout, edited, 2);
      for (const std::uint64_t window : edited) run_of[window] = 2;
      facts.shrink_to(limit);
      facts.finish();
      for (const std::uint64_t window : edited) EXPECT_FALSE(facts.is_dropped(window));
    }
    EXPECT_LE(folder.bytes(), limit);
    const KeptFacts again(folder, layout, {});
    EXPECT_TRUE(again.has_dropped());
    const std::size_t dropped = expect_facts(again, layout, run_of);
    EXPECT_GT(dropped, 0U);
    EXPECT_LT(dropped, layout.windows());
  }
}

TEST_F(KeptFactsTest, NeverGiveUpWhatEveryRunReads) {
  const RunLayout layout = layout_of({4, 4, 4});
  KeepFolder folder = open();
  KeptFacts facts(folder, layout, {});
  add(facts, layout, all_windows(layout), 1);
  facts.shrink_to(0);
  facts.finish();
  const std::size_t dropped =
      expect_facts(facts, layout, std::vector<std::uint32_t>(layout.windows(), 1));
  std::size_t final = 0;
  const BlockRoute route(layout);
  for_windows(layout, [&](const WindowKey& key) {
    const auto blocks = layout.grid(key.march).blocks_of(key.window);
    const bool is_read = key.march == 1 && std::any_of(blocks.begin(), blocks.end(), [&](Index3 b) {
                           return route.last_version({1, b}).from == key;
                         });
    final += static_cast<std::size_t>(is_read);
  });
  EXPECT_EQ(dropped + final, layout.windows());
}

TEST_F(KeptFactsTest, AreTakenOverFromOtherProcessesOnce) {
  const RunLayout layout = layout_of({5, 4, 3});
  KeepFolder folder = open();
  KeptFacts facts(folder, layout, {});
  std::vector<std::vector<std::uint64_t>> shares(3);
  for (const std::uint64_t window : all_windows(layout)) shares[window % 3].push_back(window);
  add(facts, layout, shares[0], 1);
  for (int rank = 1; rank < 3; ++rank) {
    KeepFolder part(kept_part(folder.path(), rank), KeepUse::kGoOn);
    KeptFacts of_part(part, layout, {});
    add(of_part, layout, shares[static_cast<std::size_t>(rank)], 1);
    of_part.finish();
  }
  const std::vector<std::uint64_t> taken = facts.take_over_parts();
  EXPECT_EQ(taken[0] + taken[1], shares[1].size() + shares[2].size());
  EXPECT_TRUE(folder.parts().empty());
  EXPECT_EQ(expect_facts(facts, layout, std::vector<std::uint32_t>(layout.windows(), 1)), 0U);
}

/// A kill may leave a folder without its records, or with some that are not whole.
TEST_F(KeptFactsTest, TakeNothingFromPartsThatAreHalfThere) {
  const RunLayout layout = layout_of({3, 3, 3});
  KeepFolder folder = open();
  KeptFacts facts(folder, layout, {});
  std::filesystem::create_directories(kept_part(folder.path(), 1));
  std::ofstream(kept_part(folder.path(), 1) / kVersionsFile) << "bytes of nobody";
  std::filesystem::create_directories(kept_part(folder.path(), 2));
  std::ofstream(kept_part(folder.path(), 2) / kWindowsFile) << "";
  facts.take_over_parts();
  EXPECT_FALSE(facts.any());
  EXPECT_TRUE(folder.parts().empty());
}

}  // namespace
}  // namespace mw::engine
