// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Budget of blocks that are on their way here.
#include "engine/team/blocks/incoming_rooms.h"

#include <gtest/gtest.h>

#include "tests/engine/store/fake_run.h"

namespace mw::engine {
namespace {

using test::fake_layout;

/// Whether the next user of a version is here, asked by nobody in these tests.
class Nobody : public BlockRouter {
 public:
  [[nodiscard]] bool stays(const BlockVersion& /*version*/) const override { return true; }
  void send(const BlockVersion& /*version*/, BlockPin /*block*/) override {}
  void committed(std::span<const BlockVersion> /*versions*/) override {}
  [[nodiscard]] bool is_carrying() const override { return false; }
};

struct Receiver {
  explicit Receiver(std::uint64_t limit)
      : budget(limit), store(layout, budget, nullptr, {}, &router) {}

  [[nodiscard]] std::uint64_t used() const { return budget.used(Purpose::kBlocks); }

  RunLayout layout = fake_layout();
  MemoryBudget budget;
  Nobody router;
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
