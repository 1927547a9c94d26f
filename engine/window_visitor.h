// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What happens at one position of the window: blocks in, kernels, blocks out.
#pragma once

#include <optional>

#include "engine/block_store.h"
#include "engine/prepared_labels.h"
#include "engine/run.h"
#include "engine/window.h"
#include "kernels/lattice/graded_start.h"

namespace mw::engine {

/// Visits windows of one march.  Blocks that were never stored are made from voxels.
/// REQUIRES: windows are visited in an order that respects predecessors; the references outlive it.
class WindowVisitor {
 public:
  WindowVisitor(const PreparedLabels& labels, const Metric& metric, const MeshSettings& settings,
                const WindowGrid& grid, BlockStore& store, RunReport& report);

  void visit(Index3 window);

 private:
  void work_on(Index3 window, WindowContent& content);
  [[nodiscard]] BlockMesh take(Index3 block);

  const PreparedLabels& labels_;
  const WindowGrid& grid_;
  BlockStore& store_;
  RunReport& report_;
  Metric metric_;
  StartOptions start_;
  SimplifyOptions simplify_;
  OptimiseOptions optimise_;
  std::optional<double> max_distance_;
  std::optional<double> target_reduction_;
};

}  // namespace mw::engine
