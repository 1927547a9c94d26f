// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One process's part in a run of several: traffic, folder and epochs.
#pragma once

#include <optional>

#include "engine/exchange/epochs.h"
#include "engine/output/line_share.h"
#include "engine/run.h"
#include "engine/team_run.h"
#include "engine/team_work.h"

namespace mw::engine {

/// Put together before the store, which is given to begin(); the references outlive it.
class SharedRun {
 public:
  /// Makes sure that all ranks mean the same run, and opens the work folder, if there is to be one.
  /// ERRORS: those of agree() and TeamWork.
  /// hooks.store.workdir becomes this rank's.
  SharedRun(Team& team, const RunLayout& layout, RunHooks& hooks, const std::string& identity);

  [[nodiscard]] BlockTraffic& traffic() { return traffic_; }
  /// Of this rank; null: none.
  [[nodiscard]] Workdir* workdir() { return work_ ? &work_->own() : nullptr; }

  /// Takes up what an earlier run left, when every rank has the room that its labels take: blocks
  /// come in then.  From now on there are epochs, and all know who writes the mesh.
  void begin(RunStore& store, Partition partition);
  /// What this rank writes of it; none: rank 0 writes alone.
  [[nodiscard]] const std::optional<LineShare>& own_lines() const { return own_lines_; }
  /// Whether another run can go on from what this one leaves; rank 0 knows.
  [[nodiscard]] bool has_saved_work() const { return work_ && work_->has_saved_work(); }
  /// All windows of all ranks are done.
  void end_marches();
  /// The output is complete; returns when all ranks know, with what each did.
  [[nodiscard]] std::vector<RankFacts> end(RankFacts mine);
  /// Tells all ranks, and returns what the run ends with: the first error of this one.
  /// ENSURES: nothing uses the store any more but what comes in.
  [[nodiscard]] std::exception_ptr fail(const std::exception_ptr& error);

 private:
  Team& team_;
  const RunLayout& layout_;
  std::chrono::milliseconds every_;
  std::function<bool()> stop_;
  io::SharedMesh* together_;
  std::optional<LineShare> own_lines_;
  BlockTraffic traffic_;
  std::optional<TeamWork> work_;
  std::optional<Epochs> epochs_;
};

}  // namespace mw::engine
