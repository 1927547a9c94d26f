// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which windows of a march are ready, in memory that does not grow with the volume.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/window/window_order.h"

namespace mw::engine {

/// Says which windows may start; each is given by its rank in the order.  Thread safety: none.
class Front {
 public:
  virtual ~Front() = default;

  /// Returns the ready window with the longest path to go, among equals the first in sequence.
  [[nodiscard]] virtual std::optional<std::uint64_t> best() const = 0;
  /// Returns the first of its windows in sequence that is unfinished, or the order's size().
  [[nodiscard]] virtual std::uint64_t first_unfinished() const = 0;
  [[nodiscard]] virtual bool is_ready(std::uint64_t rank) const = 0;
  /// REQUIRES: ready.
  virtual void start(std::uint64_t rank) = 0;
  /// REQUIRES: started, not finished.
  virtual void finish(std::uint64_t rank) = 0;
};

/// Returns the window that a free thread starts: the best one or, where that may not start, the
/// first unfinished one; nothing where neither may.  may_start(rank) is asked in that order.
template <typename MayStart>
[[nodiscard]] std::optional<std::uint64_t> window_to_start(const Front& front,
                                                           const MayStart& may_start) {
  const std::optional<std::uint64_t> best = front.best();
  if (!best || may_start(*best)) return best;
  const std::uint64_t first = front.first_unfinished();
  if (front.is_ready(first) && may_start(first)) return first;
  return std::nullopt;
}

/// True if an earlier run has finished the window.
using IsFinished = std::function<bool(Index3 window)>;

/// Returns how far ahead a march of this many threads looks if it is not set.  In simulated marches
/// over 343 and 9261 windows with 2 to 32 cores this was at most 1.5 % slower than looking ahead
/// without end, with fewer blocks in use: for 2 cores in the colour order only those of the
/// sequence's three layers.
[[nodiscard]] constexpr std::uint64_t default_look_ahead(std::size_t threads) {
  return 128 * std::uint64_t{threads};
}

/// Follows a march.  Windows come into being when the sequence's first unfinished window is less
/// than `look_ahead` ranks away, and are forgotten once the first unfinished one has passed them.
/// There is no counter per window: a window is ready when its predecessors, which come before it
/// in the sequence, are either forgotten or marked finished.
///
/// Memory: min(look_ahead, windows) bytes, and at most as many ready windows.
/// Cost: O(log look_ahead) a window.  Thread safety: none.
class Wavefront : public Front {
 public:
  /// REQUIRES: look_ahead >= 1; the windows finished before are closed under predecessors; order
  /// outlives this.
  Wavefront(const WindowOrder& order, std::uint64_t look_ahead, IsFinished finished_before = {});

  [[nodiscard]] std::optional<std::uint64_t> best() const override;
  /// This window is ready unless it runs.
  [[nodiscard]] std::uint64_t first_unfinished() const override { return first_; }
  [[nodiscard]] bool is_ready(std::uint64_t rank) const override;
  [[nodiscard]] std::size_t ready_count() const { return ready_.size(); }
  /// Returns how many windows it can hold at a time.
  [[nodiscard]] std::size_t capacity() const { return states_.size(); }

  void start(std::uint64_t rank) override;
  void finish(std::uint64_t rank) override;

 private:
  enum class State : std::uint8_t { kWaiting, kReady, kRunning, kFinished };
  using Priority = std::pair<std::int64_t, std::uint64_t>;

  [[nodiscard]] State& state(std::uint64_t rank) { return states_[rank % states_.size()]; }
  [[nodiscard]] bool is_finished(std::uint64_t rank) const;
  [[nodiscard]] Priority priority(std::uint64_t rank) const;
  void make_ready_if_due(std::uint64_t rank);
  void advance();

  const WindowOrder& order_;
  IsFinished finished_before_;
  std::vector<State> states_;  // states of ranks first_ to created_ - 1, in a ring
  std::uint64_t first_ = 0;
  std::uint64_t created_ = 0;
  std::set<Priority> ready_;
};

}  // namespace mw::engine
