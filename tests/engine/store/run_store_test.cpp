// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The store gives what was committed under every budget, and goes on after every kind of end.
#include "engine/store/run_store.h"

#include "kernels/core/error.h"
#include "tests/engine/store/fake_run.h"
#include "tests/engine/store/volatile_files.h"
#include "tests/expect_error.h"

namespace mw::engine {
namespace {

using namespace test;

constexpr std::uint64_t kTightBytes = 60'000;  ///< a window's blocks, twice, and a few more

constexpr GroupCommit kNever{.windows = 1'000'000, .age = std::chrono::hours(1)};
constexpr GroupCommit every(std::uint64_t windows) {
  return {.windows = windows, .age = std::chrono::hours(1)};
}

TEST(RunStore, AgreesWithAMapInMemory) {
  std::mt19937 random(341);
  for (Index3 volume : {Index3{13, 9, 8}, Index3{20, 3, 1}, Index3{4, 4, 4}, Index3{7, 12, 5}}) {
    for (int marches = 1; marches <= 3; ++marches) {
      const RunLayout layout = fake_layout(volume, marches);
      MemoryBudget budget;
      RunStore store(layout, budget, nullptr);
      fake_run(layout, store, random);
      EXPECT_EQ(final_bytes(layout, store), reference_run(layout));
      EXPECT_EQ(store.facts().bytes_written, 0U);
      EXPECT_FALSE(store.has_saved_work());
    }
  }
}

TEST(RunStore, AgreesWithAMapUnderEveryBudgetAndGroup) {
  std::mt19937 random(342);
  const RunLayout layout = fake_layout({17, 11, 9}, 3);
  const FinalBytes expected = reference_run(layout);
  for (std::uint64_t memory : {kTightBytes, 2 * kTightBytes, 100 * kTightBytes}) {
    for (const GroupCommit& group : {kNever, every(1), every(7)}) {
      MemoryBudget budget(index_bytes(layout) + memory);
      VolatileFiles files;
      RunStore store(layout, budget, &files, group);
      fake_run(layout, store, random);
      EXPECT_EQ(final_bytes(layout, store), expected);
      EXPECT_LE(budget.peak(), budget.limit());
      // What a group has written leaves memory without being written again.
      EXPECT_EQ(store.facts().blocks_spilled > 0, memory < 100 * kTightBytes && group.windows != 1);
      EXPECT_EQ(store.has_saved_work(), group.windows < kNever.windows);
    }
  }
}

/// What no window has any more is used again: the file stays within a few times what lives in it.
TEST(RunStore, UsesItsFileAgain) {
  std::mt19937 random(343);
  const RunLayout layout = fake_layout({24, 24, 24}, 2);
  MemoryBudget budget(index_bytes(layout) + kTightBytes);
  VolatileFiles files;
  RunStore store(layout, budget, &files, every(5));
  fake_run(layout, store, random);
  constexpr std::uint64_t kSegment = 4 << 20;
  EXPECT_GT(store.facts().bytes_written, 5 * kSegment);
  EXPECT_LE(files.content("blocks").size(), 3 * kSegment);
}

TEST(RunStore, SaysTheLeastBudgetThatWorks) {
  std::mt19937 random(344);
  const RunLayout layout = fake_layout();
  VolatileFiles files;
  {
    MemoryBudget none(index_bytes(layout) - 1);
    EXPECT_THROW(RunStore(layout, none, &files), Error);
  }
  MemoryBudget budget(index_bytes(layout) + kTightBytes);
  RunStore store(layout, budget, &files, kNever);
  fake_run(layout, store, random);
  const std::uint64_t left = budget.limit() - budget.used(Purpose::kIndex);
  EXPECT_TRUE(store.try_reserve(Purpose::kWindows, left)) << "all blocks can be spilled";
  EXPECT_FALSE(store.try_reserve(Purpose::kWindows, left + 1));
  expect_error(ErrorKind::kResource, {"--memory 6MiB"},
               [&] { (void)store.reserve(Purpose::kWindows, 5 << 20); });
}

TEST(MemoryBudget, NamesWhatTheUserHasToGive) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  MemoryBudget shared(10 * kMebibyte, 2, 3 * kMebibyte);
  expect_error(ErrorKind::kResource, {"of 13MiB, one of 2 shares", "--memory 30MiB"},
               [&] { (void)shared.reserve(Purpose::kWindows, 12 * kMebibyte); });
  const MemoryBudget budget(10 * kMebibyte);
  EXPECT_EQ(budget.memory_with(13 * kMebibyte, 0.25), 14 * kMebibyte);
  EXPECT_EQ(budget.memory_with(8 * kMebibyte, 0.25), 8 * kMebibyte);
}

/// A window in flight keeps others out; alone, what it cannot have is an error.
TEST(RunStore, AdmitsWhatFits) {
  const RunLayout layout = fake_layout({20, 20, 20}, 1);
  MemoryBudget budget(index_bytes(layout) + 2 * kTightBytes);
  VolatileFiles files;
  RunStore store(layout, budget, &files, kNever);
  BlockStore& blocks = store.march(0);
  const Index3 near{0, 0, 0}, far{4, 4, 4};
  EXPECT_THROW((void)blocks.admit(near, 3 * kTightBytes), Error);
  expect_error(ErrorKind::kResource, {"--memory 8MiB"}, [&] {
    (void)blocks.admit(near, 3 * kTightBytes, [] { return std::uint64_t{7} << 20U; });
  });
  EXPECT_TRUE(blocks.admit(near, kTightBytes));
  EXPECT_FALSE(blocks.admit(far, kTightBytes + 1));
  EXPECT_TRUE(blocks.admit(far, kTightBytes));
  EXPECT_EQ(budget.used(Purpose::kWindows), 2 * kTightBytes);
  blocks.commit(near, fake_work(layout, {0, near}, blocks.take(near)));
  EXPECT_EQ(budget.used(Purpose::kWindows), kTightBytes);
  EXPECT_TRUE(blocks.admit(near, kTightBytes)) << "the blocks are spilled";
  EXPECT_EQ(budget.used(Purpose::kBlocks), 0U);
}

TEST(RunStore, WithoutADiskMemoryIsAllThereIs) {
  std::mt19937 random(345);
  const RunLayout layout = fake_layout();
  MemoryBudget budget(index_bytes(layout) + kTightBytes);
  RunStore store(layout, budget, nullptr);
  EXPECT_THROW(fake_run(layout, store, random), Error);
}

TEST(RunStore, RefusesBytesThatChangedOnDisk) {
  std::mt19937 random(346);
  const RunLayout layout = fake_layout();
  MemoryBudget budget(index_bytes(layout) + kTightBytes);
  VolatileFiles files;
  RunStore store(layout, budget, &files, every(3));
  fake_run(layout, store, random);
  (void)store.reserve(Purpose::kWindows, kTightBytes);  // everything goes to disk
  EXPECT_NO_THROW((void)final_bytes(layout, store));
  for (std::byte& byte : files.content("blocks")) byte ^= std::byte{1};
  expect_error(ErrorKind::kInput, {"block (0, 0, 0) of march 2: corrupt"},
               [&] { (void)final_bytes(layout, store); });
}

/// One run, ended after any number of windows and gone on with any number of times.
TEST(RunStore, GoesOnFromWhatWasSaved) {
  std::mt19937 random(347);
  const RunLayout layout = fake_layout();
  const FinalBytes expected = reference_run(layout);
  struct Stop {};
  for (int trial = 0; trial < 20; ++trial) {
    VolatileFiles files;
    const std::uint64_t step = 1 + random() % 40;
    for (std::uint64_t before = 0;;) {
      MemoryBudget budget(index_bytes(layout) + kTightBytes);
      RunStore store(layout, budget, &files, trial % 2 == 0 ? kNever : every(1 + random() % 5));
      EXPECT_EQ(store.facts().resumed_windows, before);
      expect_closed(layout, store);
      std::uint64_t left = step;
      try {
        fake_run(layout, store, random, [&] {
          if (--left == 0) throw Stop{};
        });
        EXPECT_EQ(final_bytes(layout, store), expected);
        break;
      } catch (const Stop&) {
        store.save();
        EXPECT_TRUE(store.has_saved_work());
        before += step;
      }
    }
  }
}

/// On small volumes a group may hold all of a march: a block that was recorded before it is then a
/// part of a part of one in the group, and is gone as well.  Its space is used again.
TEST(RunStore, GoesOnFromAGroupThatHoldsAMarch) {
  std::mt19937 random(349);
  const RunLayout layout = fake_layout({17, 13, 9}, 4);
  const FinalBytes expected = reference_run(layout);
  const auto windows = [&](std::uint32_t m) {
    return static_cast<std::uint64_t>(layout.grid(m).windows().product());
  };
  struct Stop {};
  for (int trial = 0; trial < 20; ++trial) {
    VolatileFiles files;
    const std::uint64_t first = 1 + random() % windows(0);
    const std::uint64_t second = windows(0) + windows(1) + 1 + random() % windows(2);
    std::uint64_t done = 0;
    const auto save_and_stop = [&](RunStore& store) {
      if (++done == first || done >= second) store.save();
      if (done + 1 == layout.windows()) throw Stop{};
    };
    MemoryBudget budget(index_bytes(layout) + kTightBytes);
    {
      RunStore store(layout, budget, &files, kNever);
      EXPECT_THROW(fake_run(layout, store, random, [&] { save_and_stop(store); }), Stop);
    }
    RunStore store(layout, budget, &files, kNever);
    EXPECT_EQ(store.facts().resumed_windows, done);
    fake_run(layout, store, random);
    EXPECT_EQ(final_bytes(layout, store), expected);
  }
}

/// The disk fails at any operation (the write that fails arrives by half), then the power is cut,
/// and that as often as the run is gone on with.
TEST(RunStore, GoesOnAfterFailingDisksAndPowerCuts) {
  std::mt19937 random(348);
  const RunLayout layout = fake_layout();
  const FinalBytes expected = reference_run(layout);
  int failures = 0, resumed = 0;
  for (int trial = 0; trial < 40; ++trial) {
    VolatileFiles files;
    const std::uint64_t group = 1 + random() % 12;
    for (;;) {
      files.fail_at = files.operations + 1 + random() % 150;
      try {
        MemoryBudget budget(index_bytes(layout) + kTightBytes);
        RunStore store(layout, budget, &files, every(group));
        if (store.facts().resumed_windows > 0) ++resumed;
        expect_closed(layout, store);
        fake_run(layout, store, random);
        ASSERT_EQ(final_bytes(layout, store), expected);
        break;
      } catch (const Error& e) {
        ASSERT_EQ(e.kind(), ErrorKind::kResource) << e.what();
        ++failures;
        files.cut_power(random);
      }
    }
  }
  EXPECT_GT(failures, 60);
  EXPECT_GT(resumed, 60);
}

/// After an error in a group nothing more is recorded, so nothing is recorded that is not durable.
TEST(RunStore, WritesNoGroupAfterOneThatFailed) {
  std::mt19937 random(349);
  const RunLayout layout = fake_layout();
  MemoryBudget budget;
  VolatileFiles files;
  RunStore store(layout, budget, &files, every(10));
  files.fail_at = files.operations + 20;
  EXPECT_THROW(fake_run(layout, store, random), Error);
  files.fail_at = ~std::uint64_t{0};
  const std::uint64_t operations = files.operations;
  store.save();
  EXPECT_EQ(files.operations, operations);
}

/// Windows in flight may hold all memory when a block comes in from another process.
TEST(RunStore, TakesInWhatMemoryDoesNotHold) {
  std::mt19937 random(350);
  const RunLayout layout = fake_layout();
  MemoryBudget budget(index_bytes(layout) + kTightBytes);
  VolatileFiles files;
  KeepsAll router;
  RunStore store(layout, budget, &files, kNever, &router);
  const std::array<Index3, 2> blocks{Index3{0, 0, 0}, Index3{1, 0, 0}};
  std::array<BlockMesh, 2> meshes;
  MemoryBudget::Reservation rest;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BlockKey key{0, blocks[i]};
    meshes[i] = random_block(random, 60);
    store.receive({key, {0, {0, 0, 0}}}, encode_block(key, meshes[i]), memory_bytes(meshes[i]));
    // The first one leaves memory for this; the page of the table that has both stays.
    if (i == 0)
      rest = store.reserve(Purpose::kWindows, budget.limit() - budget.used(Purpose::kIndex));
  }
  EXPECT_LE(budget.peak(), budget.limit());
  EXPECT_EQ(budget.used(Purpose::kBlocks), 0U);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BlockKey key{0, blocks[i]};
    EXPECT_EQ(encode_block(key, store.march(0).load(blocks[i])), encode_block(key, meshes[i]));
  }
}

/// The old blocks have left by then, and the new ones are not there: what is here must not be
/// recorded, or a resumed run would go on from blocks that no window has left.
TEST(RunStore, RecordsNothingAfterMemoryRanOutInTheMiddleOfACommit) {
  const RunLayout layout = fake_layout();
  const WindowKey first{0, {0, 0, 0}};
  MemoryBudget budget(index_bytes(layout) + kTightBytes);
  VolatileFiles files;
  KeepsAll router;
  RunStore store(layout, budget, &files, kNever, &router);
  BlockStore& march = store.march(0);
  std::vector<BlockMesh> blocks = fake_work(layout, first, march.take(first.window));
  std::uint64_t needed = 0;
  for (const BlockMesh& block : blocks) {
    needed += RunStore::cost_of(encode_block({}, block).size());
  }
  // There is room for the blocks, but not for a page of the table.
  constexpr std::uint64_t kLessThanAPage = 1000;
  auto rest = std::optional(
      store.reserve(Purpose::kWindows, budget.limit() - budget.used() - needed - kLessThanAPage));
  expect_error(ErrorKind::kResource, {}, [&] { march.commit(first.window, std::move(blocks)); });
  rest.reset();
  store.pause();
  expect_error(ErrorKind::kResource, {"memory ran out"}, [&] { store.checkpoint(); });
  EXPECT_FALSE(store.has_saved_work());
}

}  // namespace
}  // namespace mw::engine
