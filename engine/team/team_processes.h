// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A run that is divided among several processes ("ranks").
#pragma once

#include "engine/run/processes.h"
#include "engine/run/run.h"
#include "engine/team/blocks/block_traffic.h"
#include "engine/team/blocks/partition.h"
#include "engine/team/saved/epochs.h"
#include "engine/team/saved/team_work.h"
#include "engine/team/team.h"

namespace mw::engine {

/// A rank's part in a run.  All ranks make one, with the same layout.
class TeamPart : public RunPart {
 public:
  /// Makes sure that all ranks have the same run, and opens the work folder, if one is named.
  /// The references outlive it.  ERRORS: those of agree() and TeamWork.
  TeamPart(Team& team, const RunLayout& layout, const RunHooks& hooks, const std::string& identity);

  /// Returns the Workdir of this rank.
  [[nodiscard]] WorkFiles* work_files() override { return work_ ? &work_->own() : nullptr; }
  [[nodiscard]] std::filesystem::path work_folder() const override;
  [[nodiscard]] BlockRouter* router() override { return &traffic_; }
  /// Every rank has a folder of its own.  Rank 0 opens its folder first, and takes over the folders
  /// of other ranks that an earlier run has left in it.
  /// ERRORS: mw::Error(kUsage) when an earlier run has kept something there.
  [[nodiscard]] std::unique_ptr<WindowKeep> open_keep(const OpenKeep& open) override;
  [[nodiscard]] std::shared_ptr<void> attach(RunStore& store) override;

  /// Settles who visits what (Partition), by the counts of the whole volume, of which every rank
  /// reads its part.
  [[nodiscard]] LabelPlan plan_labels(const io::DenseVolume& volume, const MeshSettings& settings,
                                      const RunHooks& hooks, RunStore& store) override;
  /// Takes up what an earlier run left, and starts epochs.  Every rank has reserved the room that
  /// its labels take, so blocks may come in.
  void begin_marches(RunStore& store) override;
  [[nodiscard]] bool visits(const WindowKey& key) const override { return traffic_.is_mine(key); }
  [[nodiscard]] std::optional<PartialMarch> part_of_march(std::uint32_t march) override;
  [[nodiscard]] VisitStats end_marches(const VisitStats& own) override;

  [[nodiscard]] bool await_output() override;
  /// Rank 0 takes over the folders of all.
  void finish_keep(WindowKeep& keep) override;
  /// Returns null: epochs are over by then, so nothing more can be saved.
  [[nodiscard]] std::shared_ptr<Workdir> keep_for_rest(RunStore& /*store*/) override {
    return nullptr;
  }
  /// Returns on every rank what all did.
  [[nodiscard]] std::vector<ProcessFacts> end(const ProcessFacts& own) override;

  /// Tells all ranks that this one cannot go on.  Returns this rank's first error.
  [[nodiscard]] std::exception_ptr fail(const std::exception_ptr& error) override;
  [[nodiscard]] bool keep_work(const RunStore& store) override;

 private:
  void take_up(RunStore& store);

  Team& team_;
  const RunLayout& layout_;
  const RunHooks& hooks_;
  Partition partition_;
  BlockTraffic traffic_;
  std::optional<TeamWork> work_;
  std::optional<Epochs> epochs_;
};

/// The processes of a run as one rank sees them.  Rank 0 speaks to the user.
class TeamProcesses : public Processes {
 public:
  /// team outlives it.
  explicit TeamProcesses(Team& team) : team_(team) {}

  [[nodiscard]] int count() const override { return team_.ranks(); }
  [[nodiscard]] int count_here() const override { return team_.ranks_here(); }
  [[nodiscard]] bool speaks() const override { return team_.is_first(); }
  /// ERRORS: those of collect_together().
  [[nodiscard]] io::LabelTable collect_labels(FingerprintVolume& volume, int threads) override;
  /// No rank knows yet which windows it will visit, so this returns what every rank takes at least.
  [[nodiscard]] std::uint64_t least_bytes(const RunLayout& layout, const io::DenseVolume& volume,
                                          const MeshSettings& settings) const override;
  [[nodiscard]] std::unique_ptr<RunPart> take_part(const RunLayout& layout, const RunHooks& hooks,
                                                   const std::string& identity) override;
  void fail(const std::exception_ptr& error) override { team_.fail(error); }

 private:
  Team& team_;
};

}  // namespace mw::engine
