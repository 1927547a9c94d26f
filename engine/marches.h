// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The marches of a run: who is told of what, and what all visits add up to.
#pragma once

#include <mutex>

#include "engine/forecast/run_forecast.h"
#include "engine/run.h"

namespace mw::engine {

/// Marches one after the other.  The references outlive it.
class Marches {
 public:
  /// done: windows of an earlier run.  traffic: null where all windows are visited here.
  Marches(const RunHooks& hooks, const RunLayout& layout, RunForecast& forecast, std::uint64_t done,
          BlockTraffic* traffic)
      : hooks_(hooks), layout_(layout), forecast_(forecast), traffic_(traffic), done_(done) {}

  /// Visits all windows of the march that are this process's, and that no earlier run has done.
  /// ERRORS: those of visits, the store and the hooks; of another process.
  void run(std::uint32_t march, BlockStore& store, const WindowVisitor& visitor);

  [[nodiscard]] const VisitStats& stats() const { return stats_; }

 private:
  [[nodiscard]] bool is_mine(const WindowKey& key) const {
    return traffic_ == nullptr || traffic_->is_mine(key);
  }
  [[nodiscard]] std::uint64_t own_windows() const;
  [[nodiscard]] AdmitWindow admission(const WindowOrder& order, BlockStore& store,
                                      const WindowVisitor& visitor) const;
  void add(const VisitStats& visit);
  void note(std::uint32_t march, const Visited& v);

  const RunHooks& hooks_;
  const RunLayout& layout_;
  RunForecast& forecast_;
  BlockTraffic* traffic_;
  std::optional<std::uint64_t> total_;  ///< own windows of all marches
  std::uint64_t done_;
  Visited::Time begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  VisitStats stats_;
};

}  // namespace mw::engine
