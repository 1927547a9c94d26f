// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The march with one and with many threads: order, concurrency, admission, errors.
#include "engine/march/march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "tests/engine/march/grids.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;
using test::grid_of;
using test::kOrders;

constexpr std::array<int, 5> kThreads{1, 2, 3, 4, 8};

/// Both orders of a grid of 45 windows, with every number of threads.
template <typename Check>
void for_orders_and_threads(Check check) {
  for (Order kind : kOrders) {
    const WindowOrder order(grid_of({5, 3, 3}), kind);
    for (int threads : kThreads) {
      SCOPED_TRACE(::testing::Message()
                   << (kind == Order::kRaster ? "raster " : "colour ") << threads << " threads");
      check(order, threads);
    }
  }
}

/// Sleeps up to `microseconds`, differently at each call.  Thread-safe.
class RandomDelay {
 public:
  RandomDelay(std::uint32_t seed, std::uint32_t microseconds)
      : random_(seed), microseconds_(microseconds) {}
  void operator()() {
    std::unique_lock lock(mutex_);
    const std::chrono::microseconds delay(below(random_, microseconds_));
    lock.unlock();
    std::this_thread::sleep_for(delay);
  }

 private:
  std::mutex mutex_;
  std::mt19937 random_;
  std::uint32_t microseconds_;
};

/// Sees visits begin and end, and holds them to the march's promises.  Thread-safe.
class Watch {
 public:
  explicit Watch(const WindowOrder& order) : order_(order) {}

  void begin(Index3 window) {
    const std::lock_guard lock(mutex_);
    EXPECT_TRUE(started_.insert(order_.rank(window)).second) << "visited twice";
    for (Index3 p : order_.predecessors(window)) {
      EXPECT_EQ(finished_.count(order_.rank(p)), 1U) << "before its predecessor";
    }
    most_ = std::max(most_, started_.size() - finished_.size());
  }
  void end(Index3 window) {
    const std::lock_guard lock(mutex_);
    finished_.insert(order_.rank(window));
  }

  [[nodiscard]] std::size_t started() const { return started_.size(); }
  [[nodiscard]] std::size_t finished() const { return finished_.size(); }
  /// Visits at the same time, at most.
  [[nodiscard]] std::size_t most() const { return most_; }

 private:
  const WindowOrder& order_;
  std::mutex mutex_;
  std::set<std::uint64_t> started_, finished_;
  std::size_t most_ = 0;
};

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
      EXPECT_LE(watch.most(), static_cast<std::size_t>(threads));
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

TEST(March, NoThreadsMeansAllCores) {
  EXPECT_EQ(thread_count(0), static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
  EXPECT_EQ(thread_count(5), 5);
}

/// Visits that wait for one another, so that they must run at the same time.  Thread-safe.
class Meeting {
 public:
  explicit Meeting(int size) : size_(size) {}
  /// Waits until all have come; false when they do not within a minute.
  bool come() {
    std::unique_lock lock(mutex_);
    ++here_;
    changed_.notify_all();
    return changed_.wait_for(lock, std::chrono::minutes(1), [&] { return here_ == size_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int size_;
  int here_ = 0;
};

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
      EXPECT_LT(v.start, v.end);
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

/// A purse of places that windows hold while they run; the first window may overdraw by its own.
class Purse {
 public:
  explicit Purse(int places) : left_(std::make_shared<std::atomic<int>>(places)) {}

  Admission take(bool first) {
    if (!first && *left_ <= 0) {
      ++refused;
      return nullptr;
    }
    --*left_;
    EXPECT_GE(*left_, -1);
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
    for (int places : {0, 1, 2, 5}) {
      Watch watch(order);
      Purse purse(places);
      const VisitWindow visit = [&](Index3 w) {
        watch.begin(w);
        delay();
        watch.end(w);
      };
      march(order, visit,
            {.threads = threads, .admit = [&](Index3, bool first) { return purse.take(first); }});
      EXPECT_EQ(watch.finished(), order.size());
      EXPECT_LE(watch.most(), static_cast<std::size_t>(places + 1));
      EXPECT_EQ(purse.left(), places);
      if (threads == 8 && places == 0) {
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
    march(order, visit, {.threads = threads, .admit = [&](Index3, bool) { return nullptr; }});
    EXPECT_EQ(next, order.size());
  });
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

struct Failure {
  std::uint64_t rank;
};

/// The rank that march() throws; nothing when it does not throw.
std::optional<std::uint64_t> thrown_rank(const WindowOrder& order, const VisitWindow& visit,
                                         const MarchOptions& options) {
  try {
    march(order, visit, options);
  } catch (const Failure& failure) {
    return failure.rank;
  }
  return std::nullopt;
}

TEST(March, StopsWhenAVisitThrows) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    RandomDelay delay(425, 300);
    Watch watch(order);
    std::atomic<bool> failed = false;
    std::atomic<int> started_after = 0;
    const VisitWindow visit = [&](Index3 w) {
      if (failed) ++started_after;
      watch.begin(w);
      delay();
      if (order.rank(w) == 11) {
        failed = true;
        throw Failure{11};
      }
      watch.end(w);
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = threads}), 11U);
    // Those that were running ended; those sent before the failure was known may still start.
    EXPECT_EQ(watch.finished() + 1, watch.started());
    EXPECT_LT(started_after, threads);
    EXPECT_LT(watch.started(), order.size());
  });
}

/// All of the first colour's eight windows throw at once; the earliest in sequence is thrown on.
TEST(March, ThrowsTheEarliestOfSeveralErrors) {
  const WindowOrder order(grid_of({4, 4, 4}), Order::kColour);
  for (int repeat = 0; repeat < 10; ++repeat) {
    Meeting meeting(8);
    const VisitWindow visit = [&](Index3 w) {
      EXPECT_TRUE(meeting.come());
      throw Failure{order.rank(w)};
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = 8}), 0U);
  }
}

TEST(March, StopsWhenTheListenerThrows) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    Watch watch(order);
    std::uint64_t told = 0;
    const VisitWindow visit = [&](Index3 w) {
      watch.begin(w);
      watch.end(w);
    };
    const OnVisited stop = [&](const Visited&) {
      if (++told == 5) throw Failure{99};
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = threads, .visited = stop}), 99U);
    EXPECT_EQ(told, 5U) << "told after it threw";
    EXPECT_LT(watch.started(), 5U + static_cast<std::uint64_t>(threads));
    EXPECT_EQ(watch.finished(), watch.started());
  });
}

TEST(March, StopsWhenAdmissionThrows) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    Watch watch(order);
    const VisitWindow visit = [&](Index3 w) {
      watch.begin(w);
      watch.end(w);
    };
    const AdmitWindow admit = [&](Index3 w, bool) -> Admission {
      if (order.rank(w) == 7) throw Failure{7};
      return std::make_shared<int>(0);
    };
    EXPECT_EQ(thrown_rank(order, visit, {.threads = threads, .admit = admit}), 7U);
    EXPECT_EQ(watch.finished(), watch.started());
    EXPECT_LT(watch.started(), order.size());
  });
}

}  // namespace
}  // namespace mw::engine
