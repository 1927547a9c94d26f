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

}  // namespace mw::engine
