// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Simulated marches against what is known of every list schedule.
#include "bench/scaling/list_schedule.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/engine/march/grids.h"
#include "tests/oracle/small_volumes.h"

namespace mw::bench {
namespace {

using audit::test::below;
using engine::test::grid_of;
using engine::test::kOrders;

constexpr std::uint64_t kAll = 1 << 20;

TEST(ListSchedule, OneCoreTakesTheSum) {
  const std::vector<double> seconds(24, 0.5);
  for (engine::Order kind : kOrders) {
    EXPECT_EQ(list_schedule({grid_of({4, 3, 2}), kind}, seconds, 1, kAll), 12.0);
  }
}

TEST(ListSchedule, AnyNumberOfCoresTakesTheSteps) {
  for (engine::Order kind : kOrders) {
    const engine::WindowOrder order(grid_of({5, 4, 6}), kind);
    const std::vector<double> seconds(order.size(), 1.0);
    EXPECT_EQ(list_schedule(order, seconds, 1000, kAll), static_cast<double>(order.steps()));
    EXPECT_EQ(longest_path(order, seconds), static_cast<double>(order.steps()));
  }
}

TEST(ListSchedule, LookAheadOfOneLeavesNothingToShare) {
  const engine::WindowOrder order(grid_of({3, 3, 3}), engine::Order::kColour);
  EXPECT_EQ(list_schedule(order, std::vector<double>(27, 1.0), 8, 1), 27.0);
}

/// Graham: between the larger of path and share, and their sum.
TEST(ListSchedule, KeepsGrahamsBounds) {
  std::mt19937 random(411);
  for (int trial = 0; trial < 40; ++trial) {
    const Index3 windows{1 + below(random, 6), 1 + below(random, 6), 1 + below(random, 6)};
    for (engine::Order kind : kOrders) {
      const engine::WindowOrder order(grid_of(windows), kind);
      std::vector<double> seconds;
      for (std::uint64_t i = 0; i < order.size(); ++i) seconds.push_back(below(random, 100));
      const double path = longest_path(order, seconds);
      const double work = std::accumulate(seconds.begin(), seconds.end(), 0.0);
      for (std::size_t cores : {1U, 2U, 3U, 8U}) {
        const double share = work / static_cast<double>(cores);
        const double end = list_schedule(order, seconds, cores, kAll);
        EXPECT_GE(end, std::max(path, share) - 1e-9);
        EXPECT_LE(end, path + share + 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace mw::bench
