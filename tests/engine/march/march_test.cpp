// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The march with one and with many threads: order, concurrency, admission.
#include "engine/march/march.h"

#include "tests/engine/march/watched_march.h"

namespace mw::engine {
namespace {

using namespace test;

TEST(March, VisitsEveryWindowOnceAfterItsPredecessors) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    RandomDelay delay(421, 300);
    for (int repeat = 0; repeat < 5; ++repeat) {
      Watch watch(order);
      const VisitWindow visit = [&](Index3 w) {
        watch.begin(w);
        delay();
        watch.end(w);
      };
      march(order, visit, {.threads = threads});
      EXPECT_EQ(watch.finished(), order.size());
      EXPECT_LE(watch.max(), static_cast<std::size_t>(threads));
    }
  });
}

TEST(March, OneThreadVisitsInSequence) {
  for (Order kind : kOrders) {
    const WindowOrder order(grid_of({4, 3, 3}), kind);
    const std::thread::id caller = std::this_thread::get_id();
    std::uint64_t next = 0;
    march(order, [&](Index3 w) {
      EXPECT_EQ(order.rank(w), next++);
      EXPECT_EQ(std::this_thread::get_id(), caller);
    });
    EXPECT_EQ(next, order.size());
  }
}

/// The eight windows of the first colour meet, even on a machine of fewer cores.
TEST(March, UsesAllThreads) {
  const WindowOrder order(grid_of({4, 4, 4}), Order::kColour);
  Meeting meeting(8);
  const VisitWindow visit = [&](Index3 w) {
    if (order.step(w) > 0) return;
    EXPECT_TRUE(meeting.come());
  };
  march(order, visit, {.threads = 8});
}

/// Each visit is told once, when it is over, by one thread at a time, with sound times.
TEST(March, TellsOfVisitsOneAtATime) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    RandomDelay delay(422, 200);
    Watch watch(order);
    std::atomic<int> telling = 0;
    std::set<std::uint64_t> told;
    const OnVisited visited = [&](const Visited& v) {
      EXPECT_EQ(++telling, 1);
      told.insert(order.rank(v.window));
      EXPECT_LE(v.start, v.end);
      EXPECT_GE(v.cpu_seconds, 0.0);
      EXPECT_TRUE(v.slot >= 0 && v.slot < threads);
      --telling;
    };
    const VisitWindow visit = [&](Index3 w) {
      watch.begin(w);
      delay();
      watch.end(w);
    };
    march(order, visit, {.threads = threads, .visited = visited});
    EXPECT_EQ(told.size(), order.size());
  });
}

TEST(March, PassesOverWhatWasFinishedBefore) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    // Everything up to the middle of the sequence is closed under predecessors.
    const std::uint64_t half = order.size() / 2;
    std::mutex mutex;
    std::set<std::uint64_t> visits;
    const VisitWindow visit = [&](Index3 w) {
      const std::lock_guard lock(mutex);
      visits.insert(order.rank(w));
    };
    march(order, visit,
          {.threads = threads, .finished_before = [&](Index3 w) { return order.rank(w) < half; }});
    EXPECT_EQ(visits.size(), order.size() - half);
    EXPECT_EQ(*visits.begin(), half);
    march(order, visit, {.threads = threads, .finished_before = [](Index3) { return true; }});
    EXPECT_EQ(visits.size(), order.size() - half);
  });
}

/// A purse of places that windows hold while they run.
class Purse {
 public:
  explicit Purse(int indices) : left_(std::make_shared<std::atomic<int>>(indices)) {}

  Admission take() {
    if (*left_ <= 0) {
      ++refused;
      return nullptr;
    }
    --*left_;
    return {left_.get(), [left = left_](std::atomic<int>* purse) { ++*purse; }};
  }
  [[nodiscard]] int left() const { return *left_; }

  int refused = 0;

 private:
  std::shared_ptr<std::atomic<int>> left_;
};

TEST(March, StartsOnlyWhatIsAdmitted) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    RandomDelay delay(423, 200);
    for (int indices : {0, 1, 2, 5}) {
      Watch watch(order);
      Purse purse(indices);
      const VisitWindow visit = [&](Index3 w) {
        watch.begin(w);
        delay();
        watch.end(w);
      };
      march(order, visit, {.threads = threads, .admit = [&](Index3) { return purse.take(); }});
      EXPECT_EQ(watch.finished(), order.size());
      EXPECT_LE(watch.max(), static_cast<std::size_t>(std::max(indices, 1)));
      EXPECT_EQ(purse.left(), indices);
      if (threads == 8 && indices == 0) {
        EXPECT_GT(purse.refused, 0);
      }
    }
  });
}

/// With everything refused only the first unfinished window runs: the sequence, and no lock-up.
TEST(March, RunsInSequenceWhenEverythingIsRefused) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    std::uint64_t next = 0;
    std::atomic<int> running = 0;
    const VisitWindow visit = [&](Index3 w) {
      EXPECT_EQ(++running, 1);
      EXPECT_EQ(order.rank(w), next++);
      --running;
    };
    march(order, visit, {.threads = threads, .admit = [&](Index3) { return nullptr; }});
    EXPECT_EQ(next, order.size());
  });
}

/// What an earlier run finished may leave windows ready that come before the sequence's first, as a
/// run under a tight budget that goes on after a kill has it: no window waits for one that the
/// march has asked for and not begun.
TEST(March, EndsWithRoomForOneWhateverWasFinishedBefore) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    std::mt19937 random(425);
    for (int i = 0; i < 10; ++i) {
      std::set<std::uint64_t> done;
      for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
        const auto before = order.predecessors(order.window(rank));
        const bool may_be_done = std::all_of(
            before.begin(), before.end(), [&](Index3 w) { return done.contains(order.rank(w)); });
        if (may_be_done && random() % 3 != 0) done.insert(rank);
      }
      Purse purse(1);
      std::atomic<std::uint64_t> visits = 0;
      march(order, [&](Index3) { ++visits; },
            {.threads = threads,
             .admit = [&](Index3) { return purse.take(); },
             .finished_before = [&](Index3 w) { return done.contains(order.rank(w)); }});
      EXPECT_EQ(visits + done.size(), order.size());
    }
  });
}

/// Whatever fails between two visits ends the march, also while it waits for inputs.
TEST(March, EndsWhenItCannotLookForItsNextWindow) {
  const WindowOrder order(grid_of({3, 1, 1}), Order::kColour);
  for (int threads : kThreads) {
    Arrivals arrivals;
    std::atomic<bool> is_out_of_memory = false;
    const PartialMarch part{.is_mine = [](Index3) { return true; },
                            .inputs = [&](Index3 w) -> std::uint32_t {
                              if (is_out_of_memory) throw std::bad_alloc();
                              return w.x == 0 ? 0 : 1;
                            },
                            .arrivals = &arrivals};
    std::atomic<int> visits = 0;
    const VisitWindow visit = [&](Index3) {
      ++visits;
      is_out_of_memory = true;
      for (std::uint64_t rank = 0; rank < order.size(); ++rank) arrivals.add({0, rank});
    };
    EXPECT_THROW(march(order, visit, {.threads = threads, .part = &part}), std::bad_alloc);
    EXPECT_EQ(visits, 1);
  }
}

/// No window starts far from the first unfinished one.
TEST(March, KeepsToItsLookAhead) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    RandomDelay delay(424, 200);
    std::mutex mutex;
    std::set<std::uint64_t> unfinished;
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) unfinished.insert(rank);
    const VisitWindow visit = [&](Index3 w) {
      {
        const std::lock_guard lock(mutex);
        EXPECT_LT(order.rank(w), *unfinished.begin() + 6);
      }
      delay();
      const std::lock_guard lock(mutex);
      unfinished.erase(order.rank(w));
    };
    march(order, visit, {.threads = threads, .look_ahead = 6});
    EXPECT_TRUE(unfinished.empty());
  });
}

}  // namespace
}  // namespace mw::engine
