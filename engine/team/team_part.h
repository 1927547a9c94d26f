// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One rank's part in a run of several processes: traffic, folder and epochs.
#pragma once

#include "engine/run/run.h"
#include "engine/team/block_traffic.h"
#include "engine/team/epochs.h"
#include "engine/team/line_share.h"
#include "engine/team/team_work.h"

namespace mw::engine {

/// All ranks make one, with the same layout.
class TeamPart : public RunPart {
 public:
  /// Makes sure that all ranks mean the same run, and opens the work folder, if there is to be one.
  /// The references outlive it.  ERRORS: those of agree() and TeamWork.
  TeamPart(Team& team, const RunLayout& layout, const RunHooks& hooks, const std::string& identity);

  /// The Workdir of this rank.
  [[nodiscard]] WorkFiles* work_files() override { return work_ ? &work_->own() : nullptr; }
  [[nodiscard]] std::filesystem::path work_folder() const override;
  [[nodiscard]] BlockRouter* router() override { return &traffic_; }
  [[nodiscard]] std::shared_ptr<void> attach(RunStore& store) override;

  /// Settles who visits what (Partition), by the counts of the whole volume, of which every rank
  /// reads its part.
  [[nodiscard]] LabelPlan plan_labels(const io::DenseVolume& volume, const MeshSettings& settings,
                                      const RunHooks& hooks, RunStore& store) override;
  /// Every rank has the room that its labels take, so blocks may come in: takes up what an earlier
  /// run left.  From now on there are epochs, and all know who writes the mesh.
  void begin_marches(RunStore& store) override;
  [[nodiscard]] bool visits(const WindowKey& key) const override { return traffic_.is_mine(key); }
  [[nodiscard]] std::optional<PartialMarch> part_of_march(std::uint32_t march) override;
  [[nodiscard]] VisitStats end_marches(const VisitStats& own) override;

  [[nodiscard]] bool await_output() override;
  [[nodiscard]] bool writes_with_others() const override { return own_lines_.has_value(); }
  [[nodiscard]] FinishedMesh write(FinalBlocks& blocks, const WindowGrid& grid,
                                   const io::DenseVolume& volume, io::MeshSink& sink,
                                   const OutputOptions& options) override;
  /// Every rank gets what all did.
  [[nodiscard]] std::vector<ProcessFacts> end(const ProcessFacts& own) override;

  /// Tells all ranks.  Returns the first error of this one.
  [[nodiscard]] std::exception_ptr fail(const std::exception_ptr& error) override;
  [[nodiscard]] bool keep_work(const RunStore& store) override;

 private:
  void take_up(RunStore& store);

  Team& team_;
  const RunLayout& layout_;
  const RunHooks& hooks_;
  Partition partition_;
  std::optional<LineShare> own_lines_;  ///< what this rank writes; none: rank 0 writes alone
  BlockTraffic traffic_;
  std::optional<TeamWork> work_;
  std::optional<Epochs> epochs_;
};

}  // namespace mw::engine
