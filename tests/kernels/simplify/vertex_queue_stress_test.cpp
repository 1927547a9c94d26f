// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Real threads at the queue: nothing lost, nothing twice, the reference's order.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/kernels/simplify/reference_queue.h"

namespace mw::test {
namespace {

using audit::test::below;

/// Threads that start their work together, as near as can be.
template <class Work>
void run_together(std::size_t threads, Work&& work) {
  std::atomic<std::size_t> waiting{threads};
  std::vector<std::thread> all;
  for (std::size_t t = 0; t < threads; ++t) {
    all.emplace_back([&, t] {
      --waiting;
      while (waiting != 0) std::this_thread::yield();
      work(t);
    });
  }
  for (std::thread& t : all) t.join();
}

/// Entry i goes to producer i % producers: neighbours in a word come from different threads.
void push_dealt(VertexQueue& queue, const std::vector<Entry>& entries, std::size_t producers) {
  run_together(producers, [&](std::size_t t) {
    for (std::size_t i = t; i < entries.size(); i += producers) {
      queue.push(entries[i].v, entries[i].cost);
    }
  });
}

TEST(Promise5SameBytes, VertexQueueForgetsWhichThreadPushed) {
  std::mt19937 random(711);
  for (std::size_t i = 0; i < 64 && !HasFailure(); ++i) {
    const LocalVertex vertices = 1 + below(random, 500);
    const auto entries = random_entries(random, 2000, vertices);
    const auto push_all = [&](VertexQueue& queue, const std::vector<Entry>& all) {
      push_dealt(queue, all, all.empty() ? 0 : 1 + i % 8);
    };
    ASSERT_EQ(drain<VertexQueue>(entries, vertices, push_all), reference_rounds(entries, vertices));
  }
}

/// An entry of one word pushed by every producer at once.
TEST(VertexQueue, ManyProducersOfOneVertexMakeOneEntry) {
  std::vector<LocalVertex> round;
  for (int i = 0; i < 200; ++i) {
    VertexQueue queue(64);
    run_together(8, [&](std::size_t t) {
      for (LocalVertex v = 0; v < 64; ++v)
        queue.push((v + 8 * static_cast<LocalVertex>(t)) % 64, 1);
    });
    ASSERT_TRUE(queue.take_round(round));
    ASSERT_EQ(round.size(), 64U);
    ASSERT_FALSE(queue.take_round(round));
  }
}

/// What the owner took while producers were pushing.
struct Taken {
  std::vector<int> times;     ///< how often each vertex came
  std::vector<double> costs;  ///< as its producer wrote them
  double bound = 0.0;
  bool in_order = true;  ///< bounds never fell and no vertex came before its bucket's turn
};

void take_all(VertexQueue& queue, const std::vector<double>& written, Taken& taken) {
  for (std::vector<LocalVertex> round; queue.take_round(round);) {
    taken.in_order &= queue.current_bound() >= taken.bound;
    taken.bound = queue.current_bound();
    for (LocalVertex v : round) {
      ++taken.times[v];
      taken.costs[v] = written[v];
      taken.in_order &= written[v] <= taken.bound;
    }
  }
}

/// The producer's plain write before a push is read by the owner after the take: a race, unless the
/// queue orders the two.
TEST(VertexQueue, OwnerMayDrainWhileProducersPush) {
  constexpr LocalVertex kVertices = 1U << 14;
  std::mt19937 random(712);
  for (std::size_t i = 0; i < 60 && !HasFailure(); ++i) {
    const std::size_t producers = 1 + i % 8;
    std::vector<double> costs(kVertices), written(kVertices, -1.0);
    for (double& c : costs) c = VertexQueue::bound(below(random, VertexQueue::kBuckets));
    VertexQueue queue(kVertices);
    Taken taken{std::vector<int>(kVertices), std::vector<double>(kVertices)};
    std::atomic<std::size_t> producing{producers};
    const auto produce = [&](std::size_t t) {
      for (std::size_t v = t; v < kVertices; v += producers) {
        written[v] = costs[v];
        queue.push(static_cast<LocalVertex>(v), costs[v]);
      }
      --producing;
    };
    const auto own = [&] {
      while (producing != 0) take_all(queue, written, taken);
      take_all(queue, written, taken);
    };
    run_together(producers + 1, [&](std::size_t t) { t == producers ? own() : produce(t); });
    ASSERT_EQ(taken.times, std::vector<int>(kVertices, 1));
    ASSERT_EQ(taken.costs, costs);
    EXPECT_TRUE(taken.in_order);
  }
}

}  // namespace
}  // namespace mw::test
