// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/blocks/partition.h"
#include "engine/team/blocks/block_traffic.h"
#include "tests/engine/march/grids.h"
#include "tests/engine/store/fake_run.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;
using namespace test;

RunLayout layout_of(Index3 windows, Order order) {
  const WindowGrid first = grid_of(windows);
  return RunLayout({first, WindowGrid(first.volume(), 8)}, order);
}

TEST(Partition, OfOneRankIsEverything) {
  const RunLayout layout = layout_of({3, 4, 5}, Order::kColour);
  for (const Partition& p : {Partition(), Partition(layout, Order::kColour, 1)}) {
    for (std::uint32_t march = 0; march < 2; ++march) {
      for_each_index(layout.grid(march).windows(), [&](Index3 w) {
        EXPECT_EQ(p.rank_of({march, w}), 0);
      });
    }
  }
}

TEST(Partition, BricksShareTheCostEvenly) {
  std::mt19937 random(7);
  const RunLayout layout = layout_of({5, 40, 50}, Order::kColour);
  for (int ranks : {2, 3, 4, 7, 8, 16}) {
    std::vector<double> costs(40 * 50);
    for (double& c : costs) c = 1 + below(random, 10);
    const Partition p(layout, Order::kColour, ranks, costs);
    std::vector<double> loads(static_cast<std::size_t>(ranks));
    for (std::size_t row = 0; row < costs.size(); ++row) loads[p.owners()[row]] += costs[row];
    const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / ranks;
    for (double load : loads) EXPECT_NEAR(load / mean, 1.0, 0.3) << ranks << " ranks";
  }
}

/// The rows of a rank are a box: nothing of another rank lies between them.
TEST(Partition, BricksAreBoxes) {
  const RunLayout layout = layout_of({2, 13, 17}, Order::kColour);
  for (int ranks = 1; ranks <= 12; ++ranks) {
    const Partition p(layout, Order::kColour, ranks);
    std::vector<std::set<std::int64_t>> y(12), z(12);
    std::vector<std::size_t> rows(12);
    for (std::size_t row = 0; row < p.owners().size(); ++row) {
      const std::uint32_t rank = p.owners()[row];
      y[rank].insert(static_cast<std::int64_t>(row % 13));
      z[rank].insert(static_cast<std::int64_t>(row / 13));
      ++rows[rank];
    }
    for (std::size_t rank = 0; rank < static_cast<std::size_t>(ranks); ++rank) {
      EXPECT_GT(rows[rank], 0U);
      EXPECT_EQ(y[rank].size() * z[rank].size(), rows[rank]);
    }
  }
}

TEST(Partition, BricksBeginAtRowsThatNeedNotWait) {
  const RunLayout layout = layout_of({2, 127, 127}, Order::kColour);
  for (int ranks : {2, 4, 16, 64}) {
    const Partition p(layout, Order::kColour, ranks);
    for (std::size_t row = 0; row + 1 < p.owners().size(); ++row) {
      const std::size_t y = row % 127, z = row / 127;
      if (y + 1 < 127 && p.owners()[row] != p.owners()[row + 1]) {
        EXPECT_EQ((y + 1) % 4, 0U);
      }
      if (z + 1 < 127 && p.owners()[row] != p.owners()[row + 127]) {
        EXPECT_EQ((z + 1) % 4, 0U);
      }
    }
  }
}

TEST(Partition, RowsStayWholeAndLaterMarchesFollow) {
  for (Order order : test::kOrders) {
    const RunLayout layout = layout_of({9, 20, 24}, order);
    const Partition p(layout, order, 4);
    for_each_index(layout.grid(0).windows(), [&](Index3 w) {
      EXPECT_EQ(p.rank_of({0, w}), p.rank_of({0, {0, w.y, w.z}}));
    });
    for_each_index(layout.grid(1).windows(), [&](Index3 w) {
      const Index3 middle{0, std::min<std::int64_t>(2 * w.y + 1, 19),
                          std::min<std::int64_t>(2 * w.z + 1, 23)};
      EXPECT_EQ(p.rank_of({1, w}), p.rank_of({0, middle}));
    });
  }
}

TEST(Partition, MoreRanksThanRowsLeavesSomeIdle) {
  const RunLayout layout = layout_of({4, 1, 2}, Order::kColour);
  const Partition p(layout, Order::kColour, 8);
  const std::set<std::uint32_t> used(p.owners().begin(), p.owners().end());
  EXPECT_EQ(used.size(), 2U);
}

TEST(Partition, IsWhatItsOwnersSay) {
  const RunLayout layout = layout_of({4, 9, 7}, Order::kColour);
  const Partition counted(layout, Order::kColour, 5);
  const Partition told(layout, counted.owners());
  for_each_index(layout.grid(0).windows(), [&](Index3 w) {
    EXPECT_EQ(told.rank_of({0, w}), counted.rank_of({0, w}));
  });
}

// Budget of blocks that are on their way here.

struct Receiver {
  explicit Receiver(std::uint64_t limit)
      : budget(limit), store(layout, budget, nullptr, {}, &router) {}

  [[nodiscard]] std::uint64_t used() const { return budget.used(Purpose::kBlocks); }

  RunLayout layout = fake_layout();
  MemoryBudget budget;
  KeepsAll router;
  RunStore store;
};

constexpr std::uint64_t kPlenty = std::uint64_t{1} << 24U;

TEST(IncomingRooms, ABlockIsCountedOnceFromBeforeItsBytesAreThere) {
  Receiver here(kPlenty);
  const auto rooms = IncomingRooms::of(here.store);
  const std::vector<std::byte> bytes = encode_block({}, {});
  auto ticket = rooms->take(bytes.size());
  ASSERT_NE(ticket, nullptr);
  const std::uint64_t cost = RunStore::cost_of(bytes.size());
  EXPECT_EQ(here.used(), cost);
  EXPECT_FALSE(rooms->is_empty());
  const BlockVersion version{{0, {0, 0, 0}}, {0, {0, 0, 0}}};
  here.store.receive(version, bytes, 0, rooms->claim(ticket));
  EXPECT_EQ(here.used(), cost);
  EXPECT_EQ(here.budget.peak(Purpose::kBlocks), cost);
  EXPECT_FALSE(rooms->is_empty()) << "until the ticket is gone";
  ticket.reset();
  EXPECT_TRUE(rooms->is_empty());
  EXPECT_EQ(here.used(), cost);
}

TEST(IncomingRooms, ThereMayBeNoRoom) {
  Receiver here(1 << 20);
  const auto rooms = IncomingRooms::of(here.store);
  EXPECT_EQ(rooms->take(2 << 20), nullptr);
  EXPECT_TRUE(rooms->is_empty());
  EXPECT_EQ(rooms->claim(nullptr).bytes(), 0U);
}

/// A message that MPI has begun to receive is there after the run has failed.
TEST(IncomingRooms, ATicketMayOutliveTheRun) {
  std::shared_ptr<void> ticket;
  std::shared_ptr<IncomingRooms> rooms;
  {
    Receiver here(kPlenty);
    rooms = IncomingRooms::of(here.store);
    ticket = rooms->take(1000);
    EXPECT_GT(here.used(), 1000U);
    rooms->close();
    EXPECT_EQ(here.used(), 0U);
  }
  EXPECT_EQ(rooms->take(1000), nullptr);
  EXPECT_EQ(rooms->claim(ticket).bytes(), 0U);
  rooms.reset();
  ticket.reset();
}

}  // namespace
}  // namespace mw::engine
