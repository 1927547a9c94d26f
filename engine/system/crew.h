// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Threads that work together, as many as the system gives.
#pragma once

#include <oneapi/tbb/task_arena.h>

#include <functional>
#include <memory>
#include <vector>

namespace mw::engine {

/// The caller's thread and helpers in an arena of oneTBB.  This class starts the helpers itself,
/// because oneTBB ends the process where the system refuses it a thread.
/// ENSURES: oneTBB starts no thread for the work.
/// Thread safety: one thread at a time.  Cost: tens of microseconds a helper.
class Crew {
 public:
  /// Starts threads - 1 helpers, or fewer where no more can be had (`ulimit -u`, address space).
  /// REQUIRES: threads > 0.
  explicit Crew(int threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Returns the number of threads, the caller's among them.
  [[nodiscard]] int size() const { return 1 + static_cast<int>(helpers_.size()); }

  /// Runs work on this thread; helpers take part in its tasks.  ERRORS: what work throws.
  void run(const std::function<void()>& work) { arena_.execute(work); }

 private:
  class Helper;

  oneapi::tbb::task_arena arena_;
  std::vector<std::unique_ptr<Helper>> helpers_;
};

}  // namespace mw::engine
