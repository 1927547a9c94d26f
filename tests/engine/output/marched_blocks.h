// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a march leaves in the store.
#pragma once

#include "engine/output/finish.h"
#include "engine/store/run_store.h"
#include "engine/window/window_order.h"
#include "engine/window/window_visitor.h"
#include "tests/engine/memory_run.h"

namespace mw::engine::test {

/// The blocks after one march.
class MarchedBlocks : public FinalBlocks {
 public:
  MarchedBlocks(const Trial& trial, const io::DenseVolume& volume)
      : layout_({WindowGrid(trial.volume.shape, trial.settings.window)}, trial.settings.order),
        store_(layout_, budget_, nullptr) {
    const PreparedLabels labels(volume, trial.settings);
    const WindowVisitor visitor(labels, Metric(trial.frame.spacing), trial.settings, grid(),
                                store_.march(0));
    const WindowOrder order(grid(), trial.settings.order);
    for (std::uint64_t rank = 0; rank < order.size(); ++rank) visitor.visit(order.window(rank));
  }

  [[nodiscard]] BlockMesh load(Index3 block) override { return store_.march(0).load(block); }
  [[nodiscard]] const WindowGrid& grid() const { return layout_.grid(0); }
  /// Bytes of the largest block when it is loaded.
  [[nodiscard]] std::uint64_t largest() {
    std::uint64_t out = 0;
    for_each_index(grid().blocks(),
                   [&](Index3 b) { out = std::max(out, store_.march(0).loaded_bytes(b)); });
    return out;
  }

 private:
  RunLayout layout_;
  MemoryBudget budget_;
  RunStore store_;
};

}  // namespace mw::engine::test
