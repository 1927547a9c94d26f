// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lets windows of a march in when the store has memory for them.
#pragma once

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
  Admitter(const WindowGrid& grid, BlockStore& store) : grid_(grid), store_(store) {}

  /// As AdmitWindow.  ERRORS: those of BlockStore::admit.
  [[nodiscard]] Admission admit(Index3 window, bool first);
  /// To be called when a visit is over, also when it failed.
  void ended();

 private:
  const WindowGrid& grid_;
  BlockStore& store_;
  std::mutex mutex_;
  std::condition_variable over_;
  std::uint64_t started_ = 0;
  std::uint64_t ended_ = 0;
};

}  // namespace mw::engine
