// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The march: every window once, none before its predecessors (Sec 4.1), by one thread or, on a
// oneTBB flow graph, by many.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>

#include "engine/march/arrival_front.h"
#include "engine/march/wavefront.h"

namespace mw::engine {

class Crew;

/// Visits one window.  Windows without a path between them may be visited at the same time.
using VisitWindow = std::function<void(Index3 window)>;

/// Chooses among windows that are ready; returns a position in the span, which is never empty.
using PickReady = std::function<std::size_t(std::span<const Index3> ready)>;

/// Whatever a window holds while it runs, for instance a reservation of memory.
using Admission = std::shared_ptr<void>;

/// Called before a window starts, never by two threads at a time.  Null means that the window may
/// not start yet; the march asks again when another window has finished.  When no other runs, the
/// sequence's first unfinished window starts whatever the answer (except in a PartialMarch), so a
/// march cannot lock up: keep room for one window, or throw.  It must not wait for visits to end,
/// since the march may not have begun those that it asked for.  The admission is released as soon
/// as the visit is over.
using AdmitWindow = std::function<Admission(Index3 window)>;

/// A visit that is over.
struct Visited {
  using Time = std::chrono::steady_clock::time_point;

  Index3 window;
  Time start;
  Time end;
  double cpu_seconds = 0.0;  ///< time of the visiting thread
  int slot = 0;              ///< number of the visiting thread, below the number of threads
};

/// Called after each visit, in order of completion, never by two threads at a time.
using OnVisited = std::function<void(const Visited& visited)>;

/// How a march goes.  Nothing here changes its result.
struct MarchOptions {
  /// With 1, the caller's thread visits in sequence; 0 means as many threads as there are cores.
  /// There are fewer where the system gives no more.
  int threads = 1;
  /// How many ranks behind the sequence's first unfinished window others may run, which bounds the
  /// march's memory and the number of blocks in use; 0 means default_look_ahead().
  std::uint64_t look_ahead = 0;
  AdmitWindow admit;           ///< optional
  OnVisited visited;           ///< optional; may throw to stop the march
  IsFinished finished_before;  ///< optional: windows to pass over, closed under predecessors
  /// Optional; then only these windows are visited, each when its inputs are there.
  const PartialMarch* part = nullptr;
};

/// Visits all windows.  Several threads run a oneTBB flow graph of two nodes, which windows pass as
/// messages: one node visits, the other keeps the wavefront and, whenever a thread is free, sends
/// the ready window with the longest path to go.
/// ENSURES: every visit happens after the visits of its window's predecessors.
/// ERRORS: what visit, admit or visited throw, and the error of the part's arrivals.  Then no more
/// windows start, those that run end, and of several exceptions the one of the sequence's earliest
/// window is rethrown.
void march(const WindowOrder& order, const VisitWindow& visit, const MarchOptions& options = {});

/// Visits all windows one by one, in an order that respects predecessors and that `pick` decides.
/// The result is the same for every pick (promise P5).  For tests: its memory grows with windows.
void march_by_choice(const WindowOrder& order, const VisitWindow& visit, const PickReady& pick);

/// Visits the window and says when.  ERRORS: what visit throws.
[[nodiscard]] Visited timed_visit(const VisitWindow& visit, Index3 window, int slot);

/// Does what march() does, by this crew, always through the graph.  REQUIRES: order.size() >= 1.
/// Memory: that of the wavefront, and for each thread two messages and one admission.
void flow_march(const WindowOrder& order, const VisitWindow& visit, const MarchOptions& options,
                Crew& crew);

}  // namespace mw::engine
