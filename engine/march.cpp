// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Raster order, and free choice among ready windows by counting predecessors.
#include "engine/march.h"

#include "kernels/core/assert.h"

namespace mw::engine {
void march(const WindowGrid& grid, const VisitWindow& visit) {
  each_index(grid.windows(), [&](Index3 w) { visit(w); });
}

void march(const WindowGrid& grid, const VisitWindow& visit, const PickReady& pick) {
  const auto count = static_cast<std::size_t>(grid.windows().product());
  std::vector<std::vector<Index3>> successors(count);
  std::vector<std::size_t> missing(count);
  std::vector<Index3> ready;
  each_index(grid.windows(), [&](Index3 w) {
    const auto before = grid.predecessors(w);
    missing[raster(w, grid.windows())] = before.size();
    for (Index3 p : before) successors[raster(p, grid.windows())].push_back(w);
    if (before.empty()) ready.push_back(w);
  });
  while (!ready.empty()) {
    const std::size_t choice = pick(ready);
    MW_ASSERT(choice < ready.size());
    const Index3 w = ready[choice];
    ready[choice] = ready.back();
    ready.pop_back();
    visit(w);
    for (Index3 s : successors[raster(w, grid.windows())]) {
      if (--missing[raster(s, grid.windows())] == 0) ready.push_back(s);
    }
  }
}

}  // namespace mw::engine
