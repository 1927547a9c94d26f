// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Simulation of ranks, event by event.
#include "bench/scaling/team_schedule.h"

#include <algorithm>
#include <compare>
#include <functional>
#include <memory>
#include <queue>

#include "engine/march/arrival_front.h"

namespace mw::bench {
namespace {

using engine::ArrivalFront;
using engine::Arrivals;

/// Events are ordered by time; at equal times arrivals come first, then the order is by window.
struct Event {
  enum class Kind : std::uint8_t { kArrival, kEnd };

  double when = 0.0;
  Kind kind = Kind::kEnd;
  std::uint32_t window = 0;  ///< that needs what arrives, or that ends
  std::uint32_t march = 0;   ///< of the block that arrives

  friend auto operator<=>(const Event&, const Event&) = default;
};

using Events = std::priority_queue<Event, std::vector<Event>, std::greater<>>;

/// What all ranks see.
struct Run {
  const RunFlow& flow;
  std::span<const double> seconds;
  const Machines& machines;
  std::vector<engine::WindowOrder> orders;  ///< by march
  std::vector<int> owner;                   ///< by window

  [[nodiscard]] Arrivals::Window place(std::uint32_t window) const {
    const std::uint32_t march = flow.march_of(window);
    return {march, window - flow.first(march)};
  }
  [[nodiscard]] double bytes(std::uint32_t march) const {
    const auto& sizes = machines.block_bytes;
    return sizes[std::min<std::size_t>(march, sizes.size() - 1)];
  }
  [[nodiscard]] double input_bytes(std::uint32_t window) const {
    const std::uint32_t march = flow.march_of(window), seen = flow.seen(window);
    const double of_march = seen * bytes(march);
    return march == 0 ? of_march : of_march + (flow.inputs(window) - seen) * bytes(march - 1);
  }
};

/// A rank with its cores and its link.
class Player {
 public:
  Player(const Run& run, int rank) : run_(run), rank_(rank) {}

  void take(std::uint32_t window, double bytes) {
    held_ += bytes;
    most_held_ = std::max(most_held_, held_);
    arrivals_.add(run_.place(window));
    if (front_) front_->poll();
  }
  void end(std::uint32_t window) {
    --running_;
    front_->finish(run_.place(window).second);
  }
  /// Begins windows, and marches.
  void go_on(double now, Events& events) {
    while (begin_march_if_due()) {
      while (running_ < run_.machines.cores) {
        const auto best = front_->best();
        if (!best) break;
        front_->start(*best);
        ++running_;
        const std::uint32_t window = run_.flow.first(march_) + static_cast<std::uint32_t>(*best);
        held_ -= run_.input_bytes(window);
        events.push({now + run_.seconds[window], Event::Kind::kEnd, window, 0});
      }
      if (!is_march_over()) return;
    }
  }
  /// When a parcel that is handed over now will be there.
  double send(double now, double bytes) {
    link_free_ = std::max(link_free_, now) + bytes / run_.machines.bandwidth;
    ++parcels_;
    bytes_ += bytes;
    return link_free_ + run_.machines.latency;
  }

  [[nodiscard]] std::uint64_t parcels() const { return parcels_; }
  [[nodiscard]] double bytes() const { return bytes_; }
  [[nodiscard]] double most_held() const { return most_held_; }

 private:
  [[nodiscard]] bool is_march_over() const {
    return front_->first_unfinished() == run_.orders[march_].size();
  }
  /// False when all marches are over.
  bool begin_march_if_due() {
    if (front_ && !is_march_over()) return true;
    const std::uint32_t next = front_ ? march_ + 1 : march_;
    if (next == run_.orders.size()) return false;
    march_ = next;
    const std::uint32_t first = run_.flow.first(march_);
    share_.march = march_;
    share_.is_mine = [this, first](Index3 w) {
      return run_.owner[first + run_.orders[march_].rank(w)] == rank_;
    };
    share_.inputs = [this, first](Index3 w) {
      return run_.flow.inputs(first + static_cast<std::uint32_t>(run_.orders[march_].rank(w)));
    };
    share_.arrivals = &arrivals_;
    const std::uint64_t ahead = run_.machines.look_ahead > 0
                                    ? run_.machines.look_ahead
                                    : engine::default_look_ahead(run_.machines.cores);
    front_ = std::make_unique<ArrivalFront>(run_.orders[march_], share_, ahead);
    return true;
  }

  const Run& run_;
  int rank_;
  std::uint32_t march_ = 0;
  Arrivals arrivals_;
  engine::PartialMarch share_;
  std::unique_ptr<ArrivalFront> front_;
  std::size_t running_ = 0;
  double link_free_ = 0.0;
  std::uint64_t parcels_ = 0;
  double bytes_ = 0.0;
  double held_ = 0.0;
  double most_held_ = 0.0;
};

class Game {
 public:
  explicit Game(const Run& run) : run_(run) {
    for (int rank = 0; rank < run.machines.ranks; ++rank) {
      players_.push_back(std::make_unique<Player>(run, rank));
    }
  }

  TeamSchedule play() {
    for (auto& player : players_) player->go_on(0.0, events_);
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      Player& player = owner(event.window);
      if (event.kind == Event::Kind::kArrival) {
        player.take(event.window, run_.bytes(event.march));
      } else {
        hand_on(event.when, event.window);
        player.end(event.window);
        out_.seconds = event.when;
      }
      player.go_on(event.when, events_);
    }
    for (const auto& player : players_) {
      out_.parcels.push_back(player->parcels());
      out_.bytes.push_back(player->bytes());
      out_.held.push_back(player->most_held());
    }
    return out_;
  }

 private:
  [[nodiscard]] Player& owner(std::uint32_t window) {
    return *players_[static_cast<std::size_t>(run_.owner[window])];
  }

  /// The window's blocks go to those who need them next.
  void hand_on(double now, std::uint32_t window) {
    Player& from = owner(window);
    const std::uint32_t march = run_.flow.march_of(window);
    const double bytes = run_.bytes(march);
    for (std::uint32_t next : run_.flow.next_users(window)) {
      if (next == RunFlow::kOutput) {
        give_to_output(now, window, bytes);
      } else if (run_.owner[next] == run_.owner[window]) {
        from.take(next, bytes);
      } else {
        events_.push({from.send(now, bytes), Event::Kind::kArrival, next, march});
      }
    }
  }
  void give_to_output(double now, std::uint32_t window, double bytes) {
    double there = now;
    if (run_.owner[window] != 0) {
      there = owner(window).send(now, bytes);
      out_.output_bytes += bytes;
    }
    out_.output_seconds = std::max(out_.output_seconds, there);
  }

  const Run& run_;
  std::vector<std::unique_ptr<Player>> players_;
  Events events_;
  TeamSchedule out_;
};

}  // namespace

TeamSchedule team_schedule(const RunFlow& flow, std::span<const double> seconds,
                           const engine::Partition& partition, const Machines& machines) {
  Run run{.flow = flow, .seconds = seconds, .machines = machines, .orders = {}, .owner = {}};
  for (std::uint32_t march = 0; march < flow.layout().marches(); ++march) {
    run.orders.push_back(flow.layout().order(march));
  }
  for (std::uint32_t w = 0; w < flow.windows(); ++w) {
    run.owner.push_back(partition.rank_of(flow.key(w)));
  }
  return Game(run).play();
}

double longest_path(const RunFlow& flow, std::span<const double> seconds) {
  std::vector<double> ready(flow.windows());
  double longest = 0.0;
  for (std::uint32_t w = 0; w < flow.windows(); ++w) {
    const double end = ready[w] + seconds[w];
    longest = std::max(longest, end);
    for (std::uint32_t next : flow.next_users(w)) {
      if (next != RunFlow::kOutput) ready[next] = std::max(ready[next], end);
    }
  }
  return longest;
}

}  // namespace mw::bench
