// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The queue's order depends on what is in it, never on the order of pushes.
#include "kernels/simplify/vertex_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::below;

struct Entry {
  LocalVertex v = 0;
  double cost = 0.0;
};
using Rounds = std::vector<std::vector<LocalVertex>>;

/// std::shuffle differs between libraries.
void shuffle(std::vector<Entry>& entries, std::mt19937& random) {
  for (std::size_t i = entries.size(); i > 1; --i) {
    std::swap(entries[i - 1], entries[below(random, static_cast<std::uint32_t>(i))]);
  }
}

std::vector<Entry> random_entries(std::mt19937& random, std::uint32_t count) {
  std::vector<Entry> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double cost = 0.01 * static_cast<double>(std::uint64_t{1} << below(random, 20));
    out.push_back({below(random, 40), cost});
  }
  return out;
}

/// Drains a queue; some rounds push more, by their content alone, in random order.
Rounds drain(std::vector<Entry> entries, std::mt19937& random) {
  VertexQueue queue;
  shuffle(entries, random);
  for (const Entry& e : entries) queue.push(e.v, e.cost);
  Rounds rounds;
  std::vector<LocalVertex> round;
  while (queue.take_round(round)) {
    rounds.push_back(round);
    std::vector<Entry> more;
    for (LocalVertex v : round) {
      if (v % 3 == 1 && rounds.size() < 12) more.push_back({v + 100, 0.2 * (v % 7)});
    }
    shuffle(more, random);
    for (const Entry& e : more) queue.push(e.v, e.cost);
  }
  return rounds;
}

TEST(Promise5SameBytes, VertexQueueForgetsTheOrderOfPushes) {
  std::mt19937 random(701);
  for (int i = 0; i < 100; ++i) {
    const std::vector<Entry> entries = random_entries(random, 60);
    const Rounds expected = drain(entries, random);
    for (int k = 0; k < 10; ++k) ASSERT_EQ(drain(entries, random), expected);
  }
}

TEST(VertexQueue, DrainsBucketsUpwardsAndEachAscendingOnce) {
  std::mt19937 random(702);
  for (int i = 0; i < 100; ++i) {
    const std::vector<Entry> entries = random_entries(random, 60);
    VertexQueue queue;
    for (const Entry& e : entries) queue.push(e.v, e.cost);
    std::vector<LocalVertex> round;
    double below_bound = -1.0;
    for (std::size_t bucket = 0; bucket < VertexQueue::kBuckets; ++bucket) {
      const double bound = 0.125 * std::pow(4.0, static_cast<double>(bucket));
      std::vector<LocalVertex> expected;
      for (const Entry& e : entries) {
        if (e.cost > below_bound && e.cost <= bound) expected.push_back(e.v);
      }
      below_bound = bound;
      std::sort(expected.begin(), expected.end());
      expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
      if (expected.empty()) continue;
      ASSERT_TRUE(queue.take_round(round));
      ASSERT_EQ(round, expected);
      ASSERT_EQ(queue.current_bound(), bound);
    }
    ASSERT_FALSE(queue.take_round(round));
  }
}

TEST(VertexQueue, FilesCheaperOnesUnderTheBucketBeingDrainedAndForgetsTheDearest) {
  VertexQueue queue;
  std::vector<LocalVertex> round;
  queue.push(5, VertexQueue::bound(3));
  queue.push(6, std::numeric_limits<double>::infinity());
  queue.push(7, VertexQueue::bound(VertexQueue::kBuckets - 1) * 1.001);
  ASSERT_TRUE(queue.take_round(round));
  EXPECT_EQ(round, std::vector<LocalVertex>{5});
  queue.push(9, 0.0);
  queue.push(8, VertexQueue::bound(3));
  ASSERT_TRUE(queue.take_round(round));
  EXPECT_EQ(round, (std::vector<LocalVertex>{8, 9}));
  EXPECT_EQ(queue.current_bound(), VertexQueue::bound(3));
  EXPECT_FALSE(queue.take_round(round));
}

}  // namespace
}  // namespace mw::test
