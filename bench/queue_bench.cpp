// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The lock-free queue of simplify() against heaps: pushes and drains of as many vertices as a large
// window has, by 1 to 8 producers.
#include <benchmark/benchmark.h>

#include <barrier>
#include <chrono>
#include <mutex>
#include <queue>
#include <random>
#include <thread>

#include "kernels/simplify/vertex_queue.h"

namespace mw {
namespace {

constexpr LocalVertex kVertices = 1U << 19;

struct Entry {
  double cost = 0.0;
  LocalVertex v = 0;
  friend auto operator<=>(const Entry&, const Entry&) = default;
};

/// Every vertex once, ascending as seeding goes; three quarters in the lower half of the buckets.
std::vector<Entry> entries() {
  std::mt19937 random(1);
  std::vector<Entry> out(kVertices);
  for (LocalVertex v = 0; v < kVertices; ++v) {
    const std::size_t bucket = random() % 4 != 0 ? random() % 6 : 6 + random() % 6;
    out[v] = {VertexQueue::bound(bucket) * (0.3 + 0.0007 * static_cast<double>(random() % 1000)),
              v};
  }
  return out;
}

/// The total order by a heap; one thread.
class Heap {
 public:
  explicit Heap(LocalVertex) {}
  void push(LocalVertex v, double cost) { heap_.push({cost, v}); }
  std::size_t drain() {
    std::size_t taken = 0;
    for (; !heap_.empty(); heap_.pop()) {
      LocalVertex v = heap_.top().v;
      benchmark::DoNotOptimize(v);
      ++taken;
    }
    return taken;
  }

 private:
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
};

/// The heap behind a lock.
class LockedHeap {
 public:
  explicit LockedHeap(LocalVertex vertices) : heap_(vertices) {}
  void push(LocalVertex v, double cost) {
    const std::scoped_lock lock(mutex_);
    heap_.push(v, cost);
  }
  std::size_t drain() { return heap_.drain(); }

 private:
  std::mutex mutex_;
  Heap heap_;
};

class Buckets {
 public:
  explicit Buckets(LocalVertex vertices) : queue_(vertices) {}
  void push(LocalVertex v, double cost) { queue_.push(v, cost); }
  std::size_t drain() {
    std::size_t taken = 0;
    for (std::vector<LocalVertex> round; queue_.take_round(round);) {
      for (LocalVertex& v : round) benchmark::DoNotOptimize(v);
      taken += round.size();
    }
    return taken;
  }

 private:
  VertexQueue queue_;
};

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Seconds from the moment all producers are ready until the last one is done.  Each has one run of
/// consecutive entries.
template <class Queue>
double push_all(Queue& queue, const std::vector<Entry>& all, std::size_t producers) {
  std::barrier gate(static_cast<std::ptrdiff_t>(producers) + 1);
  const auto produce = [&](std::size_t t) {
    gate.arrive_and_wait();
    const std::size_t last = all.size() * (t + 1) / producers;
    for (std::size_t i = all.size() * t / producers; i < last; ++i) {
      queue.push(all[i].v, all[i].cost);
    }
    gate.arrive_and_wait();
  };
  std::vector<std::jthread> threads;
  for (std::size_t t = 0; t < producers; ++t) threads.emplace_back(produce, t);
  gate.arrive_and_wait();
  const Clock::time_point start = Clock::now();
  gate.arrive_and_wait();
  return seconds_since(start);
}

/// Items are pushes; the argument is the number of producers.
template <class Queue>
void push(benchmark::State& state) {
  const std::vector<Entry> all = entries();
  for (auto _ : state) {
    Queue queue(kVertices);
    state.SetIterationTime(push_all(queue, all, static_cast<std::size_t>(state.range(0))));
  }
  state.SetItemsProcessed(state.iterations() * kVertices);
}

/// Items are vertices taken in order by the owner.
template <class Queue>
void drain(benchmark::State& state) {
  const std::vector<Entry> all = entries();
  for (auto _ : state) {
    Queue queue(kVertices);
    for (const Entry& e : all) queue.push(e.v, e.cost);
    const Clock::time_point start = Clock::now();
    const std::size_t taken = queue.drain();
    state.SetIterationTime(seconds_since(start));
    if (taken != kVertices) state.SkipWithError("entries lost");
  }
  state.SetItemsProcessed(state.iterations() * kVertices);
}

BENCHMARK(push<Heap>)->Arg(1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(push<LockedHeap>)
    ->RangeMultiplier(2)
    ->Range(1, 8)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(push<Buckets>)
    ->RangeMultiplier(2)
    ->Range(1, 8)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(drain<Heap>)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(drain<LockedHeap>)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(drain<Buckets>)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mw
