// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The front of a march of which only some windows are visited here: what they wait for, and what
// has come in.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "engine/march/wavefront.h"
#include "engine/window/window_order.h"

namespace mw::engine {

/// Counts inputs by the window that needs them next.  Thread-safe.
class Arrivals {
 public:
  using Window = std::pair<std::uint32_t, std::uint64_t>;  ///< march, rank in its order

  /// Notes that one more input is there.
  void add(Window window);
  /// Returns how many of a window's inputs are there.
  [[nodiscard]] std::uint32_t count(Window window) const;
  /// Forgets a window that has started, for which count() is not called again.
  void forget(Window window);
  /// Returns the windows of that march that got inputs since the last call.
  [[nodiscard]] std::vector<std::uint64_t> take_touched(std::uint32_t march);

  /// Wakes the march if it waits, because room may have become free, or because a thread that is
  /// none of the march's has called add().
  void wake();
  /// Ends the march with this error; only the first error counts.
  void fail(std::exception_ptr error);
  [[nodiscard]] std::exception_ptr error() const;

  /// Sets what wake() and fail() call, from any thread; an empty function is not called.
  /// ENSURES: the former one is not called any more once this returns.
  void on_wake(std::function<void()> wake);

 private:
  mutable std::mutex mutex_;
  std::map<Window, std::uint32_t> counts_;
  std::map<std::uint32_t, std::vector<std::uint64_t>> touched_;
  std::exception_ptr error_;

  std::mutex waking_;  ///< guards the next line; never taken inside mutex_
  std::function<void()> wake_;
};

/// The windows of a march that this process visits, where others are visited elsewhere.
struct PartialMarch {
  std::uint32_t march = 0;
  std::function<bool(Index3 window)> is_mine;
  /// Returns how many blocks left by other windows a window has to wait for.
  std::function<std::uint32_t(Index3 window)> inputs;
  Arrivals* arrivals = nullptr;  ///< outlives the march
};

/// The front of own windows.  They are ready when their inputs are there, whichever process they
/// come from, and are looked at when less than `look_ahead` own windows behind the first
/// unfinished one.  Memory: 9 bytes for each own window, and what waits in Arrivals.
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
  /// Makes windows ready whose inputs have come in since the last call.
  void poll();

 private:
  enum class State : std::uint8_t { kWaiting, kReady, kRunning, kFinished };
  using Priority = std::pair<std::int64_t, std::uint64_t>;

  [[nodiscard]] Priority priority(std::uint64_t rank) const;
  /// Returns the position of a rank in mine_, or nothing for a window that is visited elsewhere.
  [[nodiscard]] std::optional<std::size_t> find(std::uint64_t rank) const;
  void make_ready_if_due(std::size_t at);
  void advance();

  const WindowOrder& order_;
  const PartialMarch& part_;
  std::uint64_t look_ahead_;
  std::vector<std::uint64_t> mine_;  ///< ranks, ascending
  std::vector<State> states_;
  std::size_t first_ = 0;  ///< position in mine_ of the first unfinished window
  std::size_t seen_ = 0;   ///< end, in mine_, of the windows that are looked at
  std::set<Priority> ready_;
};

}  // namespace mw::engine
