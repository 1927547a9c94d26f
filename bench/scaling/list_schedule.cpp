// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Simulation of the march, event by event.
#include "bench/scaling/list_schedule.h"

#include <algorithm>
#include <queue>

#include "engine/march/wavefront.h"

namespace mw::bench {

double list_schedule(const engine::WindowOrder& order, std::span<const double> seconds,
                     std::size_t cores, std::uint64_t look_ahead) {
  using End = std::pair<double, std::uint64_t>;  // of a running window: when, rank
  std::priority_queue<End, std::vector<End>, std::greater<>> running;
  engine::Wavefront wavefront(order, look_ahead);
  double now = 0.0;
  while (wavefront.first_unfinished() < order.size()) {
    while (running.size() < cores) {
      const std::optional<std::uint64_t> best = wavefront.best();
      if (!best) break;
      wavefront.start(*best);
      running.emplace(now + seconds[*best], *best);
    }
    const End next = running.top();
    running.pop();
    now = next.first;
    wavefront.finish(next.second);
  }
  return now;
}

double longest_path(const engine::WindowOrder& order, std::span<const double> seconds) {
  std::vector<double> end(seconds.size());
  for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
    double start = 0.0;
    for (Index3 p : order.predecessors(order.window(rank))) {
      start = std::max(start, end[order.rank(p)]);
    }
    end[rank] = start + seconds[rank];
  }
  return end.empty() ? 0.0 : *std::max_element(end.begin(), end.end());
}

}  // namespace mw::bench
