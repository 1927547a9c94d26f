// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Simulated ranks against cases counted by hand, one rank's list schedule, and bounds.
#include "bench/scaling/team_schedule.h"
#include "bench/scaling/layouts.h"
#include "bench/scaling/list_schedule.h"
#include "engine/team/blocks/block_traffic.h"
#include "tests/engine/march/grids.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::bench {
namespace {

using audit::test::below;
using engine::Order;
using namespace engine::test;

/// Whole numbers, so that sums are exact in any order.
std::vector<double> random_seconds(const RunFlow& flow, std::mt19937& random) {
  std::vector<double> out(flow.windows());
  for (double& s : out) s = 1.0 + static_cast<double>(random() % 9);
  return out;
}

RunFlow blocks(Index3 count, std::uint32_t marches, Order order) {
  return RunFlow(run_layout(count, 2, marches, order));
}

/// Two rows of one window each, of the row z = 0 and z = 1, on two ranks.
TEST(TeamSchedule, TwoRanksOneAfterTheOtherByHand) {
  const RunFlow flow = blocks({2, 2, 3}, 1, Order::kRaster);
  ASSERT_EQ(flow.windows(), 2U);
  const engine::Partition one_each(flow.layout(), std::vector<std::uint32_t>{0, 1});
  const Machines machines{
      .ranks = 2, .cores = 1, .latency = 0.5, .bandwidth = 10.0, .block_bytes = {5.0}};
  const TeamSchedule s = team_schedule(flow, std::vector<double>{3.0, 7.0}, one_each, machines);
  // The first keeps four blocks for the output, its own; the four that both have leave at 3 and are
  // there half a second apart, the last at 3 + 4 * 0.5 + 0.5.  Then 7 more, and all eight leave.
  EXPECT_EQ(s.seconds, 12.5);
  EXPECT_EQ(s.output_seconds, 12.5 + 8 * 0.5 + 0.5);
  EXPECT_EQ(s.output_bytes, 40.0);
  EXPECT_EQ(s.parcels, (std::vector<std::uint64_t>{4, 8}));
  EXPECT_EQ(s.bytes, (std::vector<double>{20.0, 40.0}));
  EXPECT_EQ(s.held, (std::vector<double>{0.0, 20.0}));
  EXPECT_EQ(longest_path(flow, std::vector<double>{3.0, 7.0}), 10.0);
}

/// 3 x 1 x 1 windows in colour order: both ends first, then the middle; a second march of one.
TEST(TeamSchedule, CoresShareAColourByHand) {
  const RunFlow flow = blocks({4, 2, 2}, 2, Order::kColour);
  ASSERT_EQ(flow.windows(), 4U);
  // In sequence: 0, 2, 1, and the later march's.
  const std::vector<double> seconds{2.0, 5.0, 1.0, 4.0};
  const engine::Partition all(flow.layout(), Order::kColour, 1);
  EXPECT_EQ(team_schedule(flow, seconds, all, {.cores = 1}).seconds, 12.0);
  EXPECT_EQ(team_schedule(flow, seconds, all, {.cores = 2}).seconds, 10.0);
  EXPECT_EQ(longest_path(flow, seconds), 10.0);
}

TEST(TeamSchedule, OneRankIsTheListScheduleOfEachMarch) {
  std::mt19937 random(7);
  for (Order order : {Order::kRaster, Order::kColour}) {
    const RunFlow flow = blocks({7, 6, 5}, 2, order);
    const auto seconds = random_seconds(flow, random);
    const engine::Partition all(flow.layout(), order, 1);
    for (std::size_t cores : {1U, 2U, 3U, 8U}) {
      for (std::uint64_t ahead : {1U, 5U, 1000U}) {
        double expected = 0.0;
        for (std::uint32_t m = 0; m < 2; ++m) {
          const auto of_march = std::span(seconds).subspan(
              flow.first(m), std::size_t{flow.first(m + 1)} - flow.first(m));
          expected += list_schedule(flow.layout().order(m), of_march, cores, ahead);
        }
        const Machines machines{.cores = cores, .look_ahead = ahead};
        EXPECT_EQ(team_schedule(flow, seconds, all, machines).seconds, expected)
            << cores << " cores, look-ahead " << ahead;
      }
    }
  }
}

/// Two slabs, the upper one from layer `cut` on; all windows take a second.
double seconds_of_slabs(std::size_t cut, std::uint64_t look_ahead) {
  const RunFlow flow = blocks({12, 12, 18}, 1, Order::kColour);
  std::vector<std::uint32_t> owners(std::size_t{11} * 17);
  for (std::size_t row = 0; row < owners.size(); ++row) owners[row] = row / 11 < cut ? 0 : 1;
  const engine::Partition slabs(flow.layout(), owners);
  return team_schedule(flow, std::vector<double>(flow.windows(), 1.0), slabs,
                       {.ranks = 2, .cores = 1, .look_ahead = look_ahead})
      .seconds;
}

/// bench/scaling/README.md, "Predictions".
TEST(TeamSchedule, AnOddFirstLayerWaitsForTheBrickBelow) {
  const double half = 11.0 * 11.0 * 17.0 / 2.0;
  EXPECT_LT(seconds_of_slabs(8, 128), 1.1 * half);
  EXPECT_GT(seconds_of_slabs(9, 128), 1.6 * half);
  EXPECT_LT(seconds_of_slabs(9, 1000000), 1.1 * half) << "others are visited meanwhile";
}

TEST(TeamSchedule, BoundsAndParcelsHoldOnAnyRanks) {
  std::mt19937 random(11);
  int sent = 0;
  for (int round = 0; round < 60; ++round) {
    const Order order = round % 2 == 0 ? Order::kRaster : Order::kColour;
    const std::uint32_t marches = 1 + static_cast<std::uint32_t>(random() % 3);
    const auto edge = [&] { return static_cast<std::int64_t>(1 + random() % 12); };
    const RunFlow flow = blocks({edge(), edge(), edge()}, marches, order);
    const auto seconds = random_seconds(flow, random);
    const int ranks = 1 + static_cast<int>(random() % 6);
    const Machines machines{.ranks = ranks,
                            .cores = 1 + random() % 3,
                            .look_ahead = 1 + random() % 50,
                            .latency = static_cast<double>(random() % 3),
                            .bandwidth = 4.0,
                            .block_bytes = {1.0, 8.0}};
    const engine::Partition dealt = deal(flow, seconds, order, ranks);
    const TeamSchedule s = team_schedule(flow, seconds, dealt, machines);
    const double work = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    EXPECT_GE(s.seconds, longest_path(flow, seconds));
    EXPECT_GE(s.seconds * static_cast<double>(machines.cores) * ranks, work);
    EXPECT_GE(s.output_seconds, s.seconds) << "the last visit leaves blocks for the output";
    EXPECT_EQ(s.parcels, engine::blocks_sent(flow.layout(), dealt, ranks));
    for (std::uint64_t parcels : s.parcels) sent += parcels > 0 ? 1 : 0;
  }
  EXPECT_GT(sent, 60);
}

// Simulated marches against what is known of every list schedule.

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

TEST(ListSchedule, RoomForAFewWindowsIsAFewCores) {
  std::mt19937 random(412);
  for (engine::Order kind : kOrders) {
    const engine::WindowOrder order(grid_of({4, 5, 3}), kind);
    std::vector<double> seconds;
    for (std::uint64_t i = 0; i < order.size(); ++i) seconds.push_back(below(random, 100));
    const std::vector<std::uint64_t> bytes(order.size(), 10);
    for (std::size_t few : {1U, 2U, 5U}) {
      EXPECT_EQ(list_schedule(order, seconds, 16, kAll, {.bytes = bytes, .budget = 10 * few + 9}),
                list_schedule(order, seconds, few, kAll));
    }
    EXPECT_THROW((void)list_schedule(order, seconds, 16, kAll, {.bytes = bytes, .budget = 9}),
                 Error);
  }
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
