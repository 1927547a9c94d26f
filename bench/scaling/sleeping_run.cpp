// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/sleeping_run.h"

#include <atomic>
#include <chrono>
#include <latch>
#include <thread>

#include "engine/march/march.h"
#include "engine/system/crew.h"
#include "tests/engine/team/thread_exchange.h"

namespace mw::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// What all ranks see.
struct Nap {
  const RunFlow& flow;
  std::span<const double> seconds;
  const engine::Partition& partition;
  const Machines& machines;

  [[nodiscard]] int owner(std::uint32_t window) const {
    return partition.rank_of(flow.key(window));
  }
};

/// A rank: its crew sleeps, and tells who needs a window's blocks next.
class Sleeper {
 public:
  Sleeper(const Nap& nap, engine::Exchange& exchange)
      : nap_(nap), exchange_(exchange), crew_(static_cast<int>(nap.machines.cores)) {
    exchange_.listen({.receive = [this](engine::Message message) { take(message.head[0]); }});
  }
  Sleeper(const Sleeper&) = delete;
  Sleeper& operator=(const Sleeper&) = delete;
  ~Sleeper() { exchange_.listen({}); }

  void march(std::uint32_t number) {
    const engine::WindowOrder order = nap_.flow.layout().order(number);
    const auto window_at = [&](Index3 w) {
      return nap_.flow.first(number) + static_cast<std::uint32_t>(order.rank(w));
    };
    const engine::PartialMarch share{
        .march = number,
        .is_mine = [&](Index3 w) { return nap_.owner(window_at(w)) == exchange_.rank(); },
        .inputs = [&](Index3 w) { return nap_.flow.inputs(window_at(w)); },
        .arrivals = &arrivals_};
    engine::MarchOptions options{.threads = crew_.size(), .look_ahead = nap_.machines.look_ahead};
    options.part = &share;
    engine::flow_march(
        order, [&](Index3 w) { visit(window_at(w)); }, options, crew_);
  }

  [[nodiscard]] std::uint64_t parcels() const { return parcels_; }

 private:
  void visit(std::uint32_t window) {
    std::this_thread::sleep_for(std::chrono::duration<double>(nap_.seconds[window]));
    for (std::uint32_t next : nap_.flow.next_users(window)) {
      if (next == RunFlow::kOutput) continue;
      const int to = nap_.owner(next);
      if (to == exchange_.rank()) {
        add(next);
      } else {
        ++parcels_;
        exchange_.send(to, {next, 0, 0, 0}, nullptr);
      }
    }
  }
  void add(std::uint32_t window) {
    const std::uint32_t march = nap_.flow.march_of(window);
    arrivals_.add({march, window - nap_.flow.first(march)});
  }
  void take(std::uint64_t window) {
    add(static_cast<std::uint32_t>(window));
    arrivals_.wake();
  }

  const Nap& nap_;
  engine::Exchange& exchange_;
  engine::Crew crew_;
  engine::Arrivals arrivals_;
  std::atomic<std::uint64_t> parcels_ = 0;
};

}  // namespace

SleepingRun sleeping_run(const RunFlow& flow, std::span<const double> seconds,
                         const engine::Partition& partition, const Machines& machines) {
  const Nap nap{flow, seconds, partition, machines};
  const auto exchanges = engine::thread_exchanges({.ranks = machines.ranks});
  std::latch all_there(machines.ranks + 1), all_through(machines.ranks);
  SleepingRun out;
  out.parcels.resize(static_cast<std::size_t>(machines.ranks));
  std::vector<std::jthread> ranks;
  for (std::size_t rank = 0; rank < exchanges.size(); ++rank) {
    ranks.emplace_back([&, rank] {
      Sleeper sleeper(nap, *exchanges[rank]);
      all_there.arrive_and_wait();
      for (std::uint32_t m = 0; m < flow.layout().marches(); ++m) sleeper.march(m);
      out.parcels[rank] = sleeper.parcels();
      all_through.arrive_and_wait();  // others may still send here
    });
  }
  all_there.arrive_and_wait();
  const Clock::time_point begin = Clock::now();
  all_through.wait();
  out.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return out;
}

}  // namespace mw::bench
