// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Epochs: the checkpoints of a run of several processes.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "engine/team/blocks/block_traffic.h"

namespace mw::engine {

/// For each epoch all ranks start no window until none runs and no block is on its way; then each
/// makes what it has durable, rank 0 counts the epoch, and the march goes on.  What the last epoch
/// made durable stays so until the next one counts, so after a kill one that counts is there.
///
/// Each rank has a thread for epochs.  Rank 0 begins them, the others follow.
/// Thread safety: one thread makes, ends and destroys it.
class Epochs {
 public:
  struct Options {
    std::chrono::milliseconds every{300'000};
    /// Called on rank 0 when all ranks have saved the epoch of this number.  ENSURES: on return it
    /// survives a power cut.
    std::function<void(std::uint64_t epochs)> count;
    /// Optional; called often on rank 0.  True asks for an epoch, and then for StoppedAfterSave.
    std::function<bool()> stop;
  };

  /// The references outlive it.  REQUIRES: all ranks make one, and nothing has been committed yet.
  Epochs(Team& team, BlockTraffic& traffic, RunStore& store, Options options);
  Epochs(const Epochs&) = delete;
  Epochs& operator=(const Epochs&) = delete;
  /// REQUIRES: end() was called, or some rank has failed.
  ~Epochs();

  /// Makes an epoch before the march begins.  ERRORS: those of the store; that of another rank.
  void save_now() { run_one(); }
  /// Starts the thread that makes epochs.  An error in an epoch ends march and output.
  void start();
  /// Makes no more epochs.  All ranks call it after the last window of all, rank 0 before it waits
  /// for the others.
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
