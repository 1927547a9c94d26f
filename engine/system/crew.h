// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Threads that work together, as many as the system gives, and loops on them.
#pragma once

#include <oneapi/tbb/task_arena.h>

#include <functional>
#include <memory>
#include <vector>

#include "engine/system/stages.h"
#include "kernels/core/index.h"
#include "kernels/core/parallel_for.h"

namespace mw::engine {

/// Returns the number of threads that `threads` asks for: itself, or for 0 as many as there are
/// cores that this process may use, by its affinity mask and its control groups.
[[nodiscard]] int thread_count(int threads);

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

/// A ParallelFor on the threads of the arena that it is called in.  There are a few ranges a
/// thread, none so short that a body's scratch would cost more than its work.  A thread that waits
/// for the others takes no other tasks of the arena, so a window does not start inside another one.
/// ERRORS: what a body throws; other bodies may then be left out.
void tbb_for(std::size_t n, const RangeBody& body);

/// Calls visit once for every index of an array of the given shape, on `threads` threads or as many
/// as the system gives.  One thread goes in order, x fastest; several go in any order.
/// REQUIRES: threads > 0.
/// ERRORS: what a visit throws; other visits may then be left out.
void tbb_for_each_index(int threads, Index3 shape, const std::function<void(Index3)>& visit);

}  // namespace mw::engine
