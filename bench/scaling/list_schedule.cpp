// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Simulation of the march, event by event.
#include "bench/scaling/list_schedule.h"

#include <algorithm>
#include <queue>

#include "engine/march/wavefront.h"
#include "kernels/core/error.h"

namespace mw::bench {
namespace {

/// What runs, and the memory that it holds.
class Running {
 public:
  explicit Running(const WindowMemory& memory) : memory_(memory) {}

  [[nodiscard]] std::size_t size() const { return ends_.size(); }
  [[nodiscard]] bool has_room(std::uint64_t rank) const {
    return bytes_of(rank) <= memory_.budget - held_;
  }
  void start(std::uint64_t rank, double end) {
    held_ += bytes_of(rank);
    ends_.emplace(end, rank);
  }
  /// Returns the window that ends first, and when.
  std::pair<double, std::uint64_t> finish() {
    const auto next = ends_.top();
    ends_.pop();
    held_ -= bytes_of(next.second);
    return next;
  }

 private:
  using End = std::pair<double, std::uint64_t>;  // when, rank

  [[nodiscard]] std::uint64_t bytes_of(std::uint64_t rank) const {
    return memory_.bytes.empty() ? 0 : memory_.bytes[rank];
  }

  const WindowMemory& memory_;
  std::uint64_t held_ = 0;
  std::priority_queue<End, std::vector<End>, std::greater<>> ends_;
};

}  // namespace

double list_schedule(const engine::WindowOrder& order, std::span<const double> seconds,
                     std::size_t cores, std::uint64_t look_ahead, const WindowMemory& memory) {
  Running running(memory);
  engine::Wavefront wavefront(order, look_ahead);
  double now = 0.0;
  while (wavefront.first_unfinished() < order.size()) {
    while (running.size() < cores) {
      const auto has_room = [&](std::uint64_t rank) { return running.has_room(rank); };
      const std::optional<std::uint64_t> next = engine::window_to_start(wavefront, has_room);
      if (!next) break;
      wavefront.start(*next);
      running.start(*next, now + seconds[*next]);
    }
    if (running.size() == 0) throw Error(ErrorKind::kResource, "no window has room in --memory");
    const auto [end, rank] = running.finish();
    now = end;
    wavefront.finish(rank);
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
