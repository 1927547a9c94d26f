// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Who gets which rows of runs without voxels.
#include "bench/scaling/layouts.h"

#include <gtest/gtest.h>

#include <set>

namespace mw::bench {
namespace {

using engine::Order;

TEST(Layouts, EachMarchHasWindowsTwiceAsLarge) {
  const engine::RunLayout layout = run_layout({128, 96, 64}, 32, 2, Order::kRaster);
  EXPECT_EQ(layout.grid(0).windows(), (Index3{7, 5, 3}));
  EXPECT_EQ(layout.grid(1).windows(), (Index3{3, 2, 1}));
}

TEST(Layouts, DealsAsTheEngineWhereCutsAreAnywhere) {
  for (Order order : {Order::kRaster, Order::kColour}) {
    const RunFlow flow(run_layout({4, 25, 18}, 2, 2, order));
    const std::vector<double> alike(flow.windows(), 1.0);
    const engine::Partition engines(flow.layout(), order, 5);
    EXPECT_EQ(deal(flow, alike, order, 5).owners(), engines.owners());
    EXPECT_EQ(deal_like(flow, flow.layout(), order, 5).owners(), engines.owners());
  }
}

TEST(Layouts, CutsBetweenBundlesOfRows) {
  const RunFlow flow(run_layout({4, 24, 24}, 2, 1, Order::kColour));
  const std::vector<double> alike(flow.windows(), 1.0);
  const auto owners = deal(flow, alike, Order::kColour, 6, 4).owners();
  for (std::size_t z = 0; z < 23; ++z) {
    for (std::size_t y = 0; y < 23; ++y) {
      EXPECT_EQ(owners[z * 23 + y], owners[z / 4 * 4 * 23 + y / 4 * 4]);
    }
  }
  EXPECT_EQ(std::set(owners.begin(), owners.end()).size(), 6U);
}

TEST(Layouts, ASmallRunIsDealtLikeALargeOne) {
  const RunFlow near(run_layout({4, 17, 17}, 2, 1, Order::kRaster));
  const engine::RunLayout far = run_layout({4, 65, 65}, 2, 1, Order::kRaster);
  const auto owners = deal_like(near, far, Order::kRaster, 8).owners();
  // 8 tiles of 8 rows along y there are strips of 2 rows here.
  for (std::size_t row = 0; row < owners.size(); ++row) EXPECT_EQ(owners[row], row % 16 / 2);
}

}  // namespace
}  // namespace mw::bench
