// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The queue's order is that of a sorted reference, whatever the order of pushes.
#include "kernels/simplify/vertex_queue.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/kernels/simplify/reference_queue.h"

namespace mw::test {
namespace {

using audit::test::below;

/// std::shuffle differs between libraries.
void shuffle(std::vector<Entry>& entries, std::mt19937& random) {
  for (std::size_t i = entries.size(); i > 1; --i) {
    std::swap(entries[i - 1], entries[below(random, static_cast<std::uint32_t>(i))]);
  }
}

TEST(Promise5SameBytes, VertexQueueForgetsTheOrderOfPushes) {
  std::mt19937 random(701);
  std::size_t rounds = 0;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const LocalVertex vertices = 1 + below(random, 300);
    const auto entries = random_entries(random, 1 + below(random, 400), vertices);
    const Rounds expected = reference_rounds(entries, vertices);
    rounds += expected.size();
    for (int k = 0; k < 5; ++k) {
      ASSERT_EQ(drain<VertexQueue>(entries, vertices,
                                   [&](VertexQueue& queue, std::vector<Entry> all) {
                                     shuffle(all, random);
                                     for (const Entry& e : all) queue.push(e.v, e.cost);
                                   }),
                expected);
    }
  }
  EXPECT_GT(rounds, 5000U);
}

TEST(VertexQueue, TakesPushesBetweenAnyTwoRounds) {
  std::mt19937 random(702);
  for (int i = 0; i < 300; ++i) {
    const LocalVertex vertices = 1 + below(random, 200);
    VertexQueue queue(vertices);
    ReferenceQueue expected(vertices);
    std::vector<LocalVertex> round, expected_round;
    for (int step = 0; step < 60; ++step) {
      for (const Entry& e : random_entries(random, below(random, 6), vertices)) {
        queue.push(e.v, e.cost);
        expected.push(e.v, e.cost);
      }
      ASSERT_EQ(queue.take_round(round), expected.take_round(expected_round));
      ASSERT_EQ(round, expected_round);
      ASSERT_EQ(queue.current_bound(), expected.current_bound());
    }
  }
}

TEST(VertexQueue, FilesCheaperOnesUnderTheBucketBeingDrainedAndForgetsTheDearest) {
  VertexQueue queue(10);
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
  EXPECT_TRUE(round.empty());
}

TEST(VertexQueue, OfNoVerticesIsEmpty) {
  VertexQueue queue(0);
  std::vector<LocalVertex> round;
  EXPECT_FALSE(queue.take_round(round));
}

}  // namespace
}  // namespace mw::test
