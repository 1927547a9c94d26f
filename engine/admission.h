// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lets windows of a march in when the store has memory for them.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>

#include "engine/block_store.h"
#include "engine/march/march.h"

namespace mw::engine {

/// A window that finds no memory waits for others to end.  The sequence's first unfinished window
/// holds up its march meanwhile, because it must run next: what is in flight beside it needs
/// nothing from the march to end, so the wait does.
/// Thread safety: all members.
class Admitter {
 public:
  /// bytes: memory that a window takes while it is in flight.
  Admitter(BlockStore& store, std::function<std::uint64_t(Index3 window)> bytes)
      : store_(store), bytes_(std::move(bytes)) {}

  /// As AdmitWindow.  ERRORS: those of BlockStore::admit.
  [[nodiscard]] Admission admit(Index3 window, bool first);
  /// Does the work of a window that admit() was asked for.  Once one has failed the others are let
  /// pass undone, because nobody will ask for their results; either way the window has ended, and
  /// those that wait look again.  ERRORS: those of work.
  void visit(Index3 window, const VisitWindow& work);

 private:
  void end(bool failed);

  BlockStore& store_;
  std::function<std::uint64_t(Index3 window)> bytes_;
  std::mutex mutex_;
  std::condition_variable over_;
  std::uint64_t in_flight_ = 0;
  std::uint64_t ended_ = 0;
  std::atomic<bool> failed_ = false;
};

}  // namespace mw::engine
