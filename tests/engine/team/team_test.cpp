// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Teams of threads: what all say, parcels, and failures, whatever overtakes what.
#include "engine/team/team.h"

#include <thread>

#include "tests/engine/team/crowd.h"

namespace mw::engine {
namespace {

using test::for_ranks;

std::vector<std::byte> bytes(std::size_t size, int value) {
  return std::vector<std::byte>(size, static_cast<std::byte>(value));
}

TEST(Team, GathersWhatEveryoneSaysAgainAndAgain) {
  for (int ranks : {1, 2, 5}) {
    for_ranks({.ranks = ranks, .seed = 3, .max_delay = std::chrono::microseconds(2000)},
              [&](Team& team) {
                for (int round = 0; round < 20; ++round) {
                  const auto all = team.gather(std::to_string(100 * round + team.rank()));
                  ASSERT_EQ(all.size(), static_cast<std::size_t>(ranks));
                  for (int r = 0; r < ranks; ++r) {
                    EXPECT_EQ(all[static_cast<std::size_t>(r)], std::to_string(100 * round + r));
                  }
                }
              });
  }
}

TEST(Team, ParcelsArriveOnceAlsoThoseThatCameTooEarly) {
  constexpr int kRanks = 4, kEach = 50;
  for_ranks({.ranks = kRanks, .seed = 4, .max_delay = std::chrono::microseconds(3000)},
            [&](Team& team) {
              for (int to = 0; to < kRanks; ++to) {
                if (to == team.rank()) continue;
                for (std::uint64_t i = 0; i < kEach; ++i) {
                  team.send(to, {i, static_cast<std::uint64_t>(team.rank()), 7},
                            std::make_shared<std::vector<std::byte>>(bytes(i, team.rank())));
                }
              }
              std::this_thread::sleep_for(std::chrono::microseconds(500 * team.rank()));
              std::mutex mutex;
              std::set<std::pair<std::uint64_t, std::uint64_t>> seen;
              std::atomic<std::size_t> count = 0;
              team.listen({.parcel =
                               [&](const Team::Head& head, const std::vector<std::byte>& got,
                                   const std::shared_ptr<void>&) {
                                 const std::lock_guard lock(mutex);
                                 EXPECT_EQ(got, bytes(head[0], static_cast<int>(head[1])));
                                 EXPECT_EQ(head[2], 7U);
                                 seen.insert({head[0], head[1]});
                                 ++count;
                               },
                           .sent = {},
                           .failed = {}});
              while (count < kEach * (kRanks - 1)) std::this_thread::yield();
              EXPECT_EQ(seen.size(), count);
              (void)team.gather(std::string("done"));
              team.listen({});
              while (!team.is_idle()) std::this_thread::yield();
            });
}

/// A parcel brings what was returned for it; nobody asks for what is gathered.
TEST(Team, RoomIsTakenForEachParcelBeforeItComes) {
  constexpr std::uint64_t kParcels = 40;
  for_ranks({.ranks = 2, .seed = 9, .max_delay = std::chrono::microseconds(500)}, [&](Team& team) {
    std::atomic<std::uint64_t> count = 0, taken = 0;
    team.listen({.parcel =
                     [&](const Team::Head&, const std::vector<std::byte>& got,
                         const std::shared_ptr<void>& room) {
                       ASSERT_NE(room, nullptr);
                       EXPECT_EQ(*std::static_pointer_cast<std::uint64_t>(room), got.size());
                       ++count;
                     },
                 .room = [&](std::uint64_t size) -> std::shared_ptr<void> {
                   EXPECT_EQ(taken, count) << "one at a time";
                   ++taken;
                   return std::make_shared<std::uint64_t>(size);
                 }});
    (void)team.gather(std::string("all listen"));
    for (std::uint64_t i = 0; i < kParcels; ++i) {
      team.send(1 - team.rank(), {i, 0, 0},
                std::make_shared<std::vector<std::byte>>(bytes(10 * i, 1)));
    }
    while (count < kParcels) std::this_thread::yield();
    (void)team.gather(std::string("done"));
    EXPECT_EQ(taken, kParcels);
    team.listen({});
  });
}

TEST(Team, OneFailureReachesAllAndEndsWhatTheyWaitFor) {
  for_ranks({.ranks = 3, .seed = 5}, [](Team& team) {
    if (team.rank() == 1) {
      team.fail(Error(ErrorKind::kResource, "no room"));
      return;
    }
    std::atomic<bool> told = false;
    team.listen({.parcel = [](const Team::Head&, const std::vector<std::byte>&,
                              const std::shared_ptr<void>&) {},
                 .sent = {},
                 .failed = [&](const Error& e) { told = e.kind() == ErrorKind::kResource; }});
    try {
      (void)team.gather(std::string("x"));
      ADD_FAILURE() << "rank 1 said nothing";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "rank 1: no room");
    }
    while (!told) std::this_thread::yield();
    team.listen({});
    EXPECT_TRUE(team.failure().has_value());
  });
}

/// A thread of a rank fails while another one waits for what all say.
TEST(Team, AFailureEndsWhatItsOwnRankWaitsFor) {
  for_ranks({.ranks = 2, .seed = 6}, [](Team& team) {
    if (team.rank() == 1) {
      while (!team.has_failed()) std::this_thread::yield();
      return;
    }
    std::thread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      team.fail(std::make_exception_ptr(Error(ErrorKind::kResource, "the disk is full")));
    });
    try {
      (void)team.gather(std::string("x"));
      ADD_FAILURE() << "rank 1 said nothing";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "the disk is full");
    }
    other.join();
  });
}

}  // namespace
}  // namespace mw::engine
