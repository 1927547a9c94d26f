// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What happens at one position of the window: blocks in, kernels, blocks out.
#pragma once

#include <optional>

#include "engine/block_store.h"
#include "engine/run.h"
#include "engine/window.h"
#include "kernels/lattice/graded_start.h"

namespace mw::engine {

/// Visits windows of one march.  Blocks that were never stored are made from voxels.
/// REQUIRES: windows are visited in an order that respects predecessors; the references outlive it.
class WindowVisitor {
 public:
  WindowVisitor(const io::DenseVolume& volume, const MeshSettings& settings, const WindowGrid& grid,
                BlockStore& store, RunReport& report);

  void visit(Index3 window);

 private:
  void work_on(WindowContent& content);
  [[nodiscard]] BlockMesh start(Index3 block) const;

  const io::DenseVolume& volume_;
  const WindowGrid& grid_;
  BlockStore& store_;
  RunReport& report_;
  Metric metric_;
  StartOptions start_;
  SimplifyOptions simplify_;
  OptimiseOptions optimise_;
  std::optional<double> max_distance_;
};

}  // namespace mw::engine
