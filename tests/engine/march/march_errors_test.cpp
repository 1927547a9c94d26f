// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What stops a march, and what it then throws.
#include <atomic>

#include "engine/march/march.h"
#include "tests/engine/march/watched_march.h"

namespace mw::engine {
namespace {

using test::for_orders_and_threads;
using test::grid_of;
using test::Meeting;
using test::RandomDelay;
using test::Watch;

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

TEST(MarchErrors, StopsWhenAVisitThrows) {
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
TEST(MarchErrors, ThrowsTheEarliestOfSeveralErrors) {
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

TEST(MarchErrors, StopsWhenTheListenerThrows) {
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

TEST(MarchErrors, StopsWhenAdmissionThrows) {
  for_orders_and_threads([](const WindowOrder& order, int threads) {
    Watch watch(order);
    const VisitWindow visit = [&](Index3 w) {
      watch.begin(w);
      watch.end(w);
    };
    const AdmitWindow admit = [&](Index3 w) -> Admission {
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
