// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The front of a march of which only some windows are visited here.
#pragma once

#include <functional>
#include <set>
#include <vector>

#include "engine/march/arrivals.h"
#include "engine/march/wavefront.h"
#include "engine/march/window_order.h"

namespace mw::engine {

/// The windows of a march that are visited here, when others are visited elsewhere.
struct PartialMarch {
  std::uint32_t march = 0;
  std::function<bool(Index3 window)> is_mine;
  /// How many blocks that other windows leave a window has to wait for.
  std::function<std::uint32_t(Index3 window)> inputs;
  Arrivals* arrivals = nullptr;  ///< outlives the march
};

/// Own windows are ready when their inputs are there, wherever these come from.  They come
/// into view less than `look_ahead` own windows behind the first unfinished one.
/// Memory: 9 bytes an own window, and what waits in Arrivals.
class ArrivalFront : public Front {
 public:
  /// REQUIRES: look_ahead >= 1; order and part outlive this.
  ArrivalFront(const WindowOrder& order, const PartialMarch& part, std::uint64_t look_ahead,
               const IsFinished& finished_before = {});

  [[nodiscard]] std::optional<std::uint64_t> best() const override;
  [[nodiscard]] std::uint64_t first_unfinished() const override;
  [[nodiscard]] bool is_ready(std::uint64_t rank) const override;
  void start(std::uint64_t rank) override;
  void finish(std::uint64_t rank) override;
  /// Looks at what came in since the last time.
  void poll();

 private:
  enum class State : std::uint8_t { kWaiting, kReady, kRunning, kFinished };
  using Priority = std::pair<std::int64_t, std::uint64_t>;

  [[nodiscard]] Priority priority(std::uint64_t rank) const;
  /// Position of a rank in mine_, or none for a window that is visited elsewhere.
  [[nodiscard]] std::optional<std::size_t> find(std::uint64_t rank) const;
  void make_ready_if_due(std::size_t at);
  void advance();

  const WindowOrder& order_;
  const PartialMarch& part_;
  std::uint64_t look_ahead_;
  std::vector<std::uint64_t> mine_;  ///< ranks, ascending
  std::vector<State> states_;
  std::size_t first_ = 0;  ///< in mine_: the first unfinished
  std::size_t seen_ = 0;   ///< in mine_: the end of what is in view
  std::set<Priority> ready_;
};

}  // namespace mw::engine
