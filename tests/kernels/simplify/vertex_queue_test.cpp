// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The queue's order is that of a sorted reference, whatever the order of pushes.
#include <thread>

#include "kernels/simplify/vertex_queue.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

using audit::test::below;

// What VertexQueue must do, by sorting: one ordered set of (bucket, vertex).

struct Entry {
  LocalVertex v = 0;
  double cost = 0.0;
};

/// A round: its vertices and the bound of its bucket.
struct Round {
  std::vector<LocalVertex> vertices;
  double bound = 0.0;

  friend bool operator==(const Round&, const Round&) = default;
};
using Rounds = std::vector<Round>;

class ReferenceQueue {
 public:
  explicit ReferenceQueue(LocalVertex) {}

  void push(LocalVertex v, double cost) {
    int bucket = 0;
    while (cost > std::ldexp(1.0, 2 * bucket - 3)) {
      if (++bucket == 12) return;
    }
    entries_.insert({bucket, v});
  }

  bool take_round(std::vector<LocalVertex>& round) {
    round.clear();
    if (entries_.empty()) return false;
    current_ = std::max(current_, entries_.begin()->first);
    const auto end = entries_.lower_bound({current_ + 1, 0});
    for (auto e = entries_.begin(); e != end; ++e) round.push_back(e->second);
    entries_.erase(entries_.begin(), end);
    std::sort(round.begin(), round.end());
    round.erase(std::unique(round.begin(), round.end()), round.end());
    return true;
  }

  [[nodiscard]] double current_bound() const { return std::ldexp(1.0, 2 * current_ - 3); }

 private:
  std::set<std::pair<int, LocalVertex>> entries_;
  int current_ = 0;
};

/// Costs from far below the first bound to beyond the last, bounds themselves included.
[[nodiscard]] inline std::vector<Entry> random_entries(std::mt19937& random, std::uint32_t count,
                                                       LocalVertex vertices) {
  std::vector<Entry> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double power = std::ldexp(1.0, static_cast<int>(audit::test::below(random, 30)) - 6);
    const double factor = 1.0 + (audit::test::below(random, 2) == 0 ? 0.0 : 0.5);
    out.push_back({audit::test::below(random, vertices), power * factor});
  }
  return out;
}

/// What the owner's work on a round makes it push: a function of the round alone, that ends.
[[nodiscard]] inline std::vector<Entry> follow_ups(const Round& round, std::size_t rounds,
                                                   LocalVertex vertices) {
  std::vector<Entry> out;
  if (rounds > 40) return out;
  for (LocalVertex v : round.vertices) {
    if (v % 3 == 0) out.push_back({(v * 7 + 5) % vertices, 0.0});
    if (v % 3 == 1) out.push_back({v, round.bound * (1.5 + v % 5)});
  }
  return out;
}

/// All rounds of a queue of this type, or a thousand of one that never ends; `push_all(queue,
/// entries)` does the pushing.
template <class Queue, class PushAll>
[[nodiscard]] Rounds drain(const std::vector<Entry>& entries, LocalVertex vertices,
                           PushAll&& push_all) {
  Queue queue(vertices);
  push_all(queue, entries);
  Rounds rounds;
  for (Round round; rounds.size() < 1000 && queue.take_round(round.vertices);) {
    round.bound = queue.current_bound();
    rounds.push_back(round);
    push_all(queue, follow_ups(round, rounds.size(), vertices));
  }
  return rounds;
}

[[nodiscard]] inline Rounds reference_rounds(const std::vector<Entry>& entries,
                                             LocalVertex vertices) {
  return drain<ReferenceQueue>(entries, vertices, [](ReferenceQueue& queue, const auto& all) {
    for (const Entry& e : all) queue.push(e.v, e.cost);
  });
}

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

// Real threads at the queue: nothing lost, nothing twice, the reference's order.

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
