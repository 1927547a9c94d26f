// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Moments at which a run of several processes becomes durable.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "engine/team/blocks/block_traffic.h"

namespace mw::engine {

/// Now and then all ranks start no window until none runs and no block is on its way; then each
/// makes what it has durable, rank 0 counts the epoch, and the march goes on.  What was durable
/// before stays so until the epoch counts: a kill at any time leaves the last one that did.
///
/// A thread a rank.  Rank 0 begins epochs, the others follow.
/// Thread safety: one thread makes, ends and destroys it.
class Epochs {
 public:
  struct Options {
    std::chrono::milliseconds every{300'000};
    /// By rank 0, when all ranks have saved their number so-and-so; on return it survives a power
    /// cut.
    std::function<void(std::uint64_t epochs)> count;
    /// Asked often, on rank 0; true: an epoch, then StoppedAfterSave.  Optional.
    std::function<bool()> stop;
  };

  /// The references outlive it.  REQUIRES: all ranks make one, and nothing has been committed yet.
  Epochs(Team& team, BlockTraffic& traffic, RunStore& store, Options options);
  Epochs(const Epochs&) = delete;
  Epochs& operator=(const Epochs&) = delete;
  /// REQUIRES: end() was called, or some rank has failed.
  ~Epochs();

  /// One now, before the march begins.  ERRORS: those of the store; that of another rank.
  void save_now() { run_one(); }
  /// From now on they come by themselves.  An error of one ends march and output.
  void start();
  /// No more of them.  All ranks call it, after the last window of all; rank 0 before the others
  /// are waited for.
  void end();

 private:
  void lead();
  void follow();
  void run_one();
  void sleep_until(const std::function<bool()>& over) const;

  Team& team_;
  BlockTraffic& traffic_;
  RunStore& store_;
  Options options_;
  std::uint64_t epochs_ = 0;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace mw::engine
