// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The tables of a run against the route itself.
#include "bench/scaling/run_flow.h"

#include <gtest/gtest.h>

#include "bench/scaling/layouts.h"
#include "engine/team/blocks/block_route.h"

namespace mw::bench {
namespace {

using engine::Order;

TEST(RunFlow, CountsTheInputsOfTheRoute) {
  for (Order order : {Order::kRaster, Order::kColour}) {
    const RunFlow flow(run_layout({6, 1, 5}, 2, 3, order));
    const engine::BlockRoute route(flow.layout());
    for (std::uint32_t w = 0; w < flow.windows(); ++w) {
      const auto inputs = route.inputs(flow.key(w));
      EXPECT_EQ(flow.inputs(w), inputs.size());
      std::uint32_t seen = 0;
      for (const auto& input : inputs) seen += input.block.march == flow.march_of(w) ? 1U : 0U;
      EXPECT_EQ(flow.seen(w), seen);
    }
  }
}

TEST(RunFlow, KnowsFreshBlocks) {
  const RunFlow raster(run_layout({4, 4, 4}, 2, 1, Order::kRaster));
  EXPECT_EQ(raster.fresh_eighths(0), 8);
  EXPECT_EQ(raster.fresh_eighths(1), 4);
  EXPECT_EQ(raster.fresh_eighths(raster.windows() - 1), 1);
  const RunFlow colour(run_layout({4, 4, 4}, 2, 1, Order::kColour));
  EXPECT_EQ(colour.fresh_eighths(1), 8) << "the second in sequence is even, too";
  EXPECT_EQ(colour.fresh_eighths(2), 0) << "odd between two even ones";
}

}  // namespace
}  // namespace mw::bench
