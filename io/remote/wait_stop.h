// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How a wait for a server is ended.
#pragma once

#include <functional>
#include <utility>

namespace mw::io {

/// While it lives, waits of its thread for a server (HttpClient) call *stop about once a second,
/// and end with what that throws.  It hides those that the thread had before.
/// REQUIRES: stop outlives it, or is null, which ends no wait.  Thread safety: of one thread.
class WaitStop {
 public:
  using Stop = std::function<void()>;

  explicit WaitStop(const Stop* stop) : before_(std::exchange(current_, stop)) {}
  ~WaitStop() { current_ = before_; }
  WaitStop(const WaitStop&) = delete;
  WaitStop& operator=(const WaitStop&) = delete;

  /// Returns what this thread asks, for a thread that works on its behalf.
  [[nodiscard]] static const Stop* current() { return current_; }
  /// Asks.  ERRORS: what that throws.
  static void ask() {
    if (current_ != nullptr && *current_) (*current_)();
  }

 private:
  static inline thread_local const Stop* current_ = nullptr;

  const Stop* before_;
};

}  // namespace mw::io
