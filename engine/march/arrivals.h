// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What windows of this process wait for, and what has come in.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

namespace mw::engine {

/// Counts inputs by the window that needs them next.  Thread safety: all members.
class Arrivals {
 public:
  using Window = std::pair<std::uint32_t, std::uint64_t>;  ///< march, rank in its order

  /// One more input is there.
  void add(Window window);
  /// How many of a window's inputs are there.
  [[nodiscard]] std::uint32_t count(Window window) const;
  /// The window has started; nobody will ask again.
  void forget(Window window);
  /// Windows that got inputs since the last call, and belong to that march.
  [[nodiscard]] std::vector<std::uint64_t> take_touched(std::uint32_t march);

  /// Wakes the march, if one waits: room may have become free, or add() was called by a thread
  /// that is none of its own.
  void wake();
  /// The march ends with this error; the first one counts.
  void fail(std::exception_ptr error);
  [[nodiscard]] std::exception_ptr error() const;

  /// Called by wake() and fail() from any thread; empty: nobody.  ENSURES: not called any more once
  /// this returns.
  void on_wake(std::function<void()> wake);

 private:
  mutable std::mutex mutex_;
  std::map<Window, std::uint32_t> counts_;
  std::map<std::uint32_t, std::vector<std::uint64_t>> touched_;
  std::exception_ptr error_;

  std::mutex waking_;  ///< guards the next line; never taken inside mutex_
  std::function<void()> wake_;
};

}  // namespace mw::engine
