// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The marches of a run: who is told of what, and what all visits add up to.
#pragma once

#include <array>
#include <map>
#include <mutex>

#include "engine/forecast/run_forecast.h"
#include "engine/run/run_context.h"
#include "engine/window/window_memory.h"

namespace mw::engine {

/// Does the marches of a run one after the other.  The references outlive it.
class Marches {
 public:
  /// REQUIRES: RunPart::begin_marches() was called.
  Marches(RunContext& run, RunForecast& forecast)
      : run_(run), forecast_(forecast), done_(run.store.facts().resumed_windows) {}

  /// Visits all windows of the march that are visited here, and that no earlier run has done.
  /// ERRORS: those of visits, the store, the hooks and the part.
  void visit_all(std::uint32_t march, const WindowVisitor& visitor);

  [[nodiscard]] const VisitStats& stats() const { return stats_; }

 private:
  [[nodiscard]] std::uint64_t own_windows() const;
  [[nodiscard]] AdmitWindow admission(const WindowOrder& order, BlockStore& store,
                                      const WindowVisitor& visitor);
  /// Returns what the largest of the windows that are not done would take at present, and then the
  /// output.
  [[nodiscard]] std::uint64_t most_to_come(const WindowOrder& order, BlockStore& store,
                                           const WindowNeeds& needs) const;
  [[nodiscard]] bool recalls(const WindowKey& key) const;
  /// Returns true when the window is done by what an earlier run has left.
  [[nodiscard]] bool adopt(const WindowKey& key) const;
  void add(const VisitStats& visit);
  void note(std::uint32_t march, const Visited& v);

  RunContext& run_;
  RunForecast& forecast_;
  std::optional<std::uint64_t> total_;  ///< own windows of all marches
  std::uint64_t done_;
  Visited::Time begin_ = std::chrono::steady_clock::now();
  /// Bytes that windows which run or wait need.  Admission and visited are not called at once.
  std::map<std::array<std::int64_t, 3>, std::uint64_t> needed_;
  std::mutex mutex_;
  VisitStats stats_;
};

}  // namespace mw::engine
