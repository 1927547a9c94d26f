// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Windows that share no block take and commit at the same time.
#include <condition_variable>
#include <thread>

#include "engine/store/journal/run_folder.h"
#include "kernels/core/error.h"
#include "tests/engine/store/fake_run.h"
#include "tests/engine/store/work_folder.h"

namespace mw::engine {
namespace {

using namespace test;

/// Threads that take any window whose predecessors are done, and memory permitting do it.
class Workers {
 public:
  Workers(const RunLayout& layout, RunStore& store, std::uint32_t march)
      : layout_(layout), blocks_(store.march(march)), march_(march) {
    for_each_index(layout.grid(march).windows(), [&](Index3 w) { left_.push_back(w); });
  }

  void run(int threads) {
    std::vector<std::thread> all;
    for (int i = 0; i < threads; ++i) all.emplace_back([this] { work(); });
    for (std::thread& t : all) t.join();
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (!left_.empty()) {
      const auto next = std::find_if(left_.begin(), left_.end(), [&](Index3 w) {
        return is_ready(w) && blocks_.admit(w, kWindowBytes);
      });
      if (next == left_.end()) {
        changed_.wait(lock);
        continue;
      }
      const Index3 w = *next;
      left_.erase(next);
      lock.unlock();
      blocks_.commit(w, fake_work(layout_, {march_, w}, blocks_.take(w)));
      lock.lock();
      changed_.notify_all();
    }
  }

  [[nodiscard]] bool is_ready(Index3 w) const {
    const auto before = layout_.grid(march_).predecessors(w);
    return std::all_of(before.begin(), before.end(), [&](Index3 p) { return blocks_.is_done(p); });
  }

  static constexpr std::uint64_t kWindowBytes = 60'000;

  const RunLayout& layout_;
  BlockStore& blocks_;
  std::uint32_t march_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Index3> left_;
};

using ConcurrentStoreTest = test::FolderTest;

TEST_F(ConcurrentStoreTest, GivesTheSameBlocks) {
  const RunLayout layout = fake_layout({22, 18, 14}, 2);
  const auto expected = reference_run(layout);
  for (std::uint64_t windows : {2U, 5U}) {
    MemoryBudget budget(index_bytes(layout) + windows * 60'000);
    Workdir workdir(folder() / "w", false, "");
    RunStore store(layout, budget, &workdir, {.windows = 7, .age = std::chrono::hours(1)});
    for (std::uint32_t m = 0; m < layout.marches(); ++m) Workers(layout, store, m).run(4);
    EXPECT_EQ(final_bytes(layout, store), expected);
    EXPECT_LE(budget.peak(), budget.limit());
    EXPECT_EQ(budget.used(Purpose::kWindows), 0U);
    EXPECT_GT(store.facts().bytes_read, 0U);
  }
}

/// A window that ends at the very moment at which another one asks for its memory must not make it
/// look as if that memory could never be had.
TEST(ConcurrentStore, WindowsThatFitOneByOneAreNeverRefusedForGood) {
  constexpr std::uint64_t kLimit = 10 << 20, kMoreThanHalf = 6 << 20;
  const WindowGrid grid({80, 32, 32}, 32);
  const RunLayout layout({grid});
  const Index3 first{0, 0, 0}, second{2, 0, 0};
  for (int trial = 0; trial < 3000; ++trial) {
    MemoryBudget budget(kLimit);
    RunStore store(layout, budget, nullptr);
    BlockStore& march = store.march(0);
    ASSERT_TRUE(march.admit(first, kMoreThanHalf));
    std::atomic<bool> is_there = false;
    std::thread visit([&] {
      is_there = true;
      for (volatile int wait = trial % 97 * 20; wait > 0;) wait = wait - 1;
      march.commit(first, std::vector<BlockMesh>(grid.blocks_of(first).size()));
    });
    while (!is_there) std::this_thread::yield();
    const auto ask = [&] {
      while (!march.admit(second, kMoreThanHalf)) std::this_thread::yield();
    };
    EXPECT_NO_THROW(ask());
    visit.join();
  }
}

/// What any thread saved is whole: a run that goes on from it ends in the same blocks.
TEST_F(ConcurrentStoreTest, SavesWholeGroups) {
  const RunLayout layout = fake_layout({22, 18, 14}, 2);
  const auto expected = reference_run(layout);
  std::mt19937 random(361);
  Workdir workdir(folder() / "w", false, "");
  {
    MemoryBudget budget(index_bytes(layout) + 200'000);
    RunStore store(layout, budget, &workdir, {.windows = 20, .age = std::chrono::hours(1)});
    Workers(layout, store, 0).run(4);
  }
  MemoryBudget budget;
  RunStore store(layout, budget, &workdir);
  EXPECT_GT(store.facts().resumed_windows, 0U);
  test::expect_closed(layout, store);
  test::fake_run(layout, store, random);
  EXPECT_EQ(final_bytes(layout, store), expected);
}

}  // namespace
}  // namespace mw::engine
