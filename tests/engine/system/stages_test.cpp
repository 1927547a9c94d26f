// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Stages get what was spent since the stage before, and tell shared work from the rest.
#include "engine/system/stages.h"

#include <thread>

#include "engine/system/crew.h"
#include "engine/system/in_order.h"
#include "engine/system/stopwatch.h"
#include "tests/testing.h"

namespace mw::engine {
namespace {

constexpr double kSpent = 0.05;

/// Spends processor time of this thread.
void spend(double seconds) {
  const double begin = thread_cpu_seconds();
  while (thread_cpu_seconds() < begin + seconds) {
  }
}

TEST(Stages, TellSharedWorkFromWorkOfOneThread) {
  StageMeter meter;
  spend(kSpent);
  meter.end("alone");
  each_in_order<int>(
      {.threads = 1}, 4,
      [](int i) {
        spend(kSpent);
        return i;
      },
      [](int, int&&) { spend(kSpent / 4); });
  tbb_for_each_index(1, {2, 1, 1}, [](Index3) { spend(kSpent); });
  meter.end("mixed");
  spend(kSpent);
  meter.end("alone");
  const auto& costs = meter.costs();
  ASSERT_EQ(costs.size(), 2U);
  EXPECT_EQ(costs[0].name, "alone");
  EXPECT_GE(costs[0].cpu_seconds, 2 * kSpent);
  EXPECT_GE(costs[0].alone_seconds, 2 * kSpent);
  EXPECT_EQ(costs[1].name, "mixed");
  EXPECT_GE(costs[1].cpu_seconds, 7 * kSpent);
  EXPECT_GE(costs[1].alone_seconds, kSpent);
  EXPECT_GE(costs[1].cpu_seconds - costs[1].alone_seconds, 6 * kSpent);
}

TEST(Stages, WorkWithinWorkCountsOnce) {
  const double before = SharedWork::seconds();
  {
    const SharedWork outer;
    const SharedWork inner;
    spend(kSpent);
  }
  const double counted = SharedWork::seconds() - before;
  EXPECT_GE(counted, kSpent);
  EXPECT_LT(counted, 2 * kSpent);
}

TEST(Stages, EveryThreadCounts) {
  const double before = SharedWork::seconds();
  const auto work = [] {
    const SharedWork counted;
    spend(kSpent);
  };
  std::thread other(work);
  work();
  other.join();
  EXPECT_GE(SharedWork::seconds() - before, 2 * kSpent);
}

}  // namespace
}  // namespace mw::engine
