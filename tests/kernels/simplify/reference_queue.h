// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What VertexQueue must do, by sorting: one ordered set of (bucket, vertex).
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "kernels/simplify/vertex_queue.h"
#include "tests/oracle/small_volumes.h"

namespace mw::test {

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

}  // namespace mw::test
