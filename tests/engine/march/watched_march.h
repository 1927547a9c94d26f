// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Marches watched from outside: delays, meetings, and what must hold when a visit begins.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "tests/engine/march/grids.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine::test {

inline constexpr std::array<int, 5> kThreads{1, 2, 3, 4, 8};

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
    const std::chrono::microseconds delay(audit::test::below(random_, microseconds_));
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
    max_ = std::max(max_, started_.size() - finished_.size());
  }
  void end(Index3 window) {
    const std::lock_guard lock(mutex_);
    finished_.insert(order_.rank(window));
  }

  [[nodiscard]] std::size_t started() const { return started_.size(); }
  [[nodiscard]] std::size_t finished() const { return finished_.size(); }
  /// Visits at the same time, at most.
  [[nodiscard]] std::size_t max() const { return max_; }

 private:
  const WindowOrder& order_;
  std::mutex mutex_;
  std::set<std::uint64_t> started_, finished_;
  std::size_t max_ = 0;
};

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

}  // namespace mw::engine::test
