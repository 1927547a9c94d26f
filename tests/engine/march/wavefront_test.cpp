// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Readiness by brute force, the longest path first, and memory that does not grow.
#include "engine/march/wavefront.h"

#include <deque>

#include "tests/engine/march/grids.h"
#include "tests/oracle/small_volumes.h"

namespace mw::engine {
namespace {

using audit::test::below;
using namespace test;

enum class State { kWaiting, kRunning, kFinished };

/// What is ready by definition: all predecessors finished, and within the look-ahead.
std::vector<std::uint64_t> ready_by_definition(const Relation& before,
                                               const std::vector<State>& states,
                                               std::uint64_t look_ahead) {
  std::size_t first = 0;
  while (first < states.size() && states[first] == State::kFinished) ++first;
  std::vector<std::uint64_t> out;
  for (std::size_t w = 0; w < states.size() && w < first + look_ahead; ++w) {
    if (states[w] != State::kWaiting) continue;
    bool due = true;
    for (std::size_t v = 0; v < w; ++v) due &= !before[w][v] || states[v] == State::kFinished;
    if (due) out.push_back(w);
  }
  return out;
}

void expect_ready(const Wavefront& wavefront, const WindowOrder& order,
                  const std::vector<std::uint64_t>& expected) {
  ASSERT_EQ(wavefront.ready_count(), expected.size());
  for (std::uint64_t rank : expected) EXPECT_TRUE(wavefront.is_ready(rank));
  ASSERT_EQ(wavefront.best().has_value(), !expected.empty());
  if (expected.empty()) return;
  const auto urgency = [&](std::uint64_t rank) {
    return std::pair(order.step(order.window(rank)), rank);
  };
  const auto most_urgent =
      std::min_element(expected.begin(), expected.end(),
                       [&](std::uint64_t a, std::uint64_t b) { return urgency(a) < urgency(b); });
  EXPECT_EQ(*wavefront.best(), *most_urgent);
}

/// Starts and finishes windows at random, comparing after each step.
void march_at_random(const WindowOrder& order, std::uint64_t look_ahead, std::mt19937& random) {
  const Relation before = by_edges(order);
  std::vector<State> states(order.size(), State::kWaiting);
  std::vector<std::uint64_t> running;
  Wavefront wavefront(order, look_ahead);
  while (wavefront.first_unfinished() < order.size()) {
    const std::vector<std::uint64_t> ready = ready_by_definition(before, states, look_ahead);
    expect_ready(wavefront, order, ready);
    if (::testing::Test::HasFailure()) return;
    if (!ready.empty() && (running.empty() || below(random, 2) == 0)) {
      const std::uint64_t w = ready[below(random, static_cast<std::uint32_t>(ready.size()))];
      wavefront.start(w);
      states[w] = State::kRunning;
      running.push_back(w);
    } else {
      ASSERT_FALSE(running.empty()) << "nothing runs and nothing is ready";
      std::swap(running[below(random, static_cast<std::uint32_t>(running.size()))], running.back());
      wavefront.finish(running.back());
      states[running.back()] = State::kFinished;
      running.pop_back();
    }
  }
  EXPECT_EQ(std::count(states.begin(), states.end(), State::kFinished),
            static_cast<std::ptrdiff_t>(order.size()));
}

TEST(Wavefront, ReadyIsWhatTheDefinitionSays) {
  std::mt19937 random(401);
  for (const Index3 windows : {Index3{1, 1, 1}, {6, 1, 1}, {1, 5, 3}, {4, 4, 3}, {2, 3, 7}}) {
    for (Order kind : kOrders) {
      const WindowOrder order(grid_of(windows), kind);
      for (std::uint64_t look_ahead : {1U, 2U, 7U, 20U, 1000U}) {
        march_at_random(order, look_ahead, random);
      }
    }
  }
}

TEST(Wavefront, LookAheadOfOneIsTheSequence) {
  for (Order kind : kOrders) {
    const WindowOrder order(grid_of({4, 3, 3}), kind);
    Wavefront wavefront(order, 1);
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
      ASSERT_EQ(wavefront.best(), rank);
      EXPECT_EQ(wavefront.ready_count(), 1U);
      wavefront.start(rank);
      wavefront.finish(rank);
    }
  }
}

/// Windows finished before are passed over; the rest becomes ready as if they had just run.
TEST(Wavefront, GoesOnFromWhatAnEarlierRunFinished) {
  std::mt19937 random(402);
  for (Order kind : kOrders) {
    const WindowOrder order(grid_of({4, 4, 3}), kind);
    const Relation before = by_edges(order);
    for (int stop = 0; stop <= 48; stop += 6) {
      std::vector<State> states(order.size(), State::kWaiting);
      for (int i = 0; i < stop; ++i) {
        const auto ready = ready_by_definition(before, states, order.size());
        states[ready[below(random, static_cast<std::uint32_t>(ready.size()))]] = State::kFinished;
      }
      const IsFinished finished = [&](Index3 w) {
        return states[order.rank(w)] == State::kFinished;
      };
      for (std::uint64_t look_ahead : {1U, 5U, 100U}) {
        expect_ready(Wavefront(order, look_ahead, finished), order,
                     ready_by_definition(before, states, look_ahead));
      }
    }
  }
}

/// Runs windows as `threads` threads would that take the same time for each.
template <typename OnStart, typename OnFinish>
void play(const WindowOrder& order, Wavefront& wavefront, std::size_t threads, OnStart on_start,
          OnFinish on_finish) {
  std::deque<std::uint64_t> running;
  while (wavefront.first_unfinished() < order.size()) {
    while (running.size() < threads && wavefront.best()) {
      running.push_back(*wavefront.best());
      wavefront.start(running.back());
      on_start(running.back());
    }
    wavefront.finish(running.front());
    on_finish(running.front());
    running.pop_front();
  }
}

/// 120,000 windows by 64 threads: the memory is that of the look-ahead.
TEST(Wavefront, MemoryDoesNotGrowWithTheVolume) {
  constexpr std::uint64_t kLookAhead = 1000;
  for (Order kind : kOrders) {
    const WindowOrder order(grid_of({60, 50, 40}), kind);
    Wavefront wavefront(order, kLookAhead);
    std::uint64_t finished = 0;
    const auto check = [&](std::uint64_t) { ASSERT_LE(wavefront.ready_count(), kLookAhead); };
    play(order, wavefront, 64, check, [&](std::uint64_t) { ++finished; });
    EXPECT_EQ(wavefront.capacity(), kLookAhead);
    EXPECT_EQ(finished, order.size());
  }
}

/// Layers of blocks between first and last use, at most, when 8 threads march.
std::size_t layers_in_use(const WindowOrder& order, std::uint64_t look_ahead) {
  std::map<std::int64_t, std::int64_t> left;  // windows still to finish, by layer of blocks begun
  std::size_t max = 0;
  const std::int64_t in_a_layer = order.grid().windows().x * order.grid().windows().y;
  const auto windows_on = [&](std::int64_t z) {
    return (z > 0 && z + 1 < order.grid().blocks().z ? 2 : 1) * in_a_layer;
  };
  const auto layers_of = [&](std::uint64_t rank) {
    const std::int64_t z = order.window(rank).z;
    return std::array{z, z + 1};
  };
  Wavefront wavefront(order, look_ahead);
  play(
      order, wavefront, 8,
      [&](std::uint64_t rank) {
        for (std::int64_t z : layers_of(rank)) left.try_emplace(z, windows_on(z));
        max = std::max(max, left.size());
      },
      [&](std::uint64_t rank) {
        for (std::int64_t z : layers_of(rank)) {
          if (--left[z] == 0) left.erase(z);
        }
      });
  EXPECT_TRUE(left.empty());
  return max;
}

/// In sequence a march uses two or three layers; looking ahead by one adds one.
TEST(Wavefront, LookAheadBoundsTheBlocksInUse) {
  const WindowGrid grid = grid_of({12, 10, 30});
  EXPECT_LE(layers_in_use({grid, Order::kRaster}, 120), 3U);
  EXPECT_LE(layers_in_use({grid, Order::kColour}, 120), 5U);
  EXPECT_GT(layers_in_use({grid, Order::kColour}, 3600), 20U);
}

}  // namespace
}  // namespace mw::engine
