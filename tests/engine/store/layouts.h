// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Small runs for tests of what windows take from each other.
#pragma once

#include "engine/store/run_layout.h"
#include "tests/engine/march/grids.h"
#include "tests/testing.h"

namespace mw::engine::test {

/// Every number of windows up to 4 along each axis, in both orders, with 1 to 3 marches.
template <typename Check>
void for_layouts(Check check) {
  for_each_index(Index3{4, 4, 4}, [&](Index3 i) {
    const Index3 windows = i + Index3{1, 1, 1};
    for (Order order : kOrders) {
      std::vector<WindowGrid> grids{grid_of(windows)};
      const Index3 voxels = grids[0].volume();
      for (int window = 8; grids.size() < 3; window *= 2) grids.emplace_back(voxels, window);
      SCOPED_TRACE(::testing::Message() << windows.x << " " << windows.y << " " << windows.z
                                        << (order == Order::kRaster ? " raster" : " colour"));
      check(RunLayout(grids, order));
    }
  });
}

template <typename Check>
void for_windows(const RunLayout& layout, Check check) {
  for (std::uint32_t march = 0; march < layout.marches(); ++march) {
    for_each_index(layout.grid(march).windows(), [&](Index3 w) { check(WindowKey{march, w}); });
  }
}

}  // namespace mw::engine::test
