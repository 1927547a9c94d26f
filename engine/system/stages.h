// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the stages of a run cost, and how much of that no second thread can take over.
#pragma once

#include <string>
#include <vector>

namespace mw::engine {

/// Counts the processor time of the calling thread, until this is destroyed, as work that threads
/// share.  Within another one it counts nothing of its own.
/// The loops of crew.h and in_order.h and the visits of a march count themselves.
/// Thread safety: each thread has its own.  Cost: two system calls.
class SharedWork {
 public:
  SharedWork();
  ~SharedWork();
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;

  /// Returns what all threads of this process have counted, in seconds.
  [[nodiscard]] static double seconds();

 private:
  double begin_ = 0.0;
  bool is_outermost_ = false;
};

struct StageCost {
  std::string name;
  double cpu_seconds = 0.0;  ///< of all threads of the process
  /// The part of it beside SharedWork.  It is what one thread does alone in a run of one thread;
  /// with more, waiting and dividing work are in it.
  double alone_seconds = 0.0;
};

/// Divides the time of a run among its stages, which has the process for itself.
/// Thread safety: one thread at a time.
class StageMeter {
 public:
  StageMeter();

  /// Gives the stage what the process has spent since the last call, or since construction.
  void end(const std::string& name);
  /// Returns the stages in the order in which they ended first.
  [[nodiscard]] const std::vector<StageCost>& costs() const { return costs_; }

 private:
  double cpu_ = 0.0;
  double shared_ = 0.0;
  std::vector<StageCost> costs_;
};

}  // namespace mw::engine
