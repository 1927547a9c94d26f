// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A crew's helpers take part in what is run, also after a pause.
#include "engine/system/crew.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>

namespace mw::engine {
namespace {

using namespace std::chrono_literals;

/// Whether as many threads are in as many tasks at the same time.
bool all_meet(Crew& crew) {
  const int size = crew.size();
  const auto deadline = std::chrono::steady_clock::now() + 60s;
  std::atomic<int> inside = 0;
  std::atomic<bool> late = false;
  std::vector<std::atomic<int>> slots(static_cast<std::size_t>(size));
  crew.run([&] {
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<int>(0, size, 1),
        [&](const auto&) {
          ++slots.at(
              static_cast<std::size_t>(oneapi::tbb::this_task_arena::current_thread_index()));
          ++inside;
          while (inside < size && !late) {
            late = std::chrono::steady_clock::now() > deadline;
            std::this_thread::yield();
          }
        },
        oneapi::tbb::simple_partitioner());
  });
  for (const auto& times : slots) EXPECT_EQ(times, 1);
  return !late;
}

TEST(Crew, IsAsManyThreadsAsWereAskedFor) {
  for (const int threads : {1, 2, 3, 8}) {
    Crew crew(threads);
    ASSERT_EQ(crew.size(), threads);
    EXPECT_TRUE(all_meet(crew)) << threads;
    std::this_thread::sleep_for(50ms);  // by then the helpers sleep
    EXPECT_TRUE(all_meet(crew)) << threads << ", after a pause";
  }
}

TEST(Crew, ComesAndGoesWithoutWork) {
  for (int i = 0; i < 200; ++i) EXPECT_EQ(Crew(1 + i % 5).size(), 1 + i % 5);
}

TEST(Crew, PassesOnWhatTheWorkThrows) {
  Crew crew(3);
  EXPECT_THROW(crew.run([] { throw std::runtime_error("at work"); }), std::runtime_error);
  const auto fail = [](int i) {
    if (i == 77) throw std::runtime_error("in a task");
  };
  EXPECT_THROW(crew.run([&] { oneapi::tbb::parallel_for(0, 1000, fail); }), std::runtime_error);
  EXPECT_TRUE(all_meet(crew));
}

TEST(Crew, TwoOfThemDoNotMindEachOther) {
  Crew outer(3);
  Crew inner(2);
  outer.run([&] { EXPECT_TRUE(all_meet(inner)); });
  EXPECT_TRUE(all_meet(outer));
}

}  // namespace
}  // namespace mw::engine
