// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Who gets which rows of runs without voxels.
#include "bench/scaling/layouts.h"
#include "bench/scaling/visit_classes.h"
#include "kernels/core/error.h"
#include "tests/testing.h"

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

// Durations of larger runs come from windows of the same class.

/// Durations that tell march and class.
std::vector<double> telling_seconds(const RunFlow& flow) {
  std::vector<double> out;
  for (std::uint32_t w = 0; w < flow.windows(); ++w) {
    out.push_back(100.0 * flow.march_of(w) + flow.fresh_eighths(w));
  }
  return out;
}

TEST(VisitClasses, DrawsFromTheWindowsOwnClass) {
  for (Order order : {Order::kRaster, Order::kColour}) {
    const RunFlow small(run_layout({8, 8, 8}, 2, 2, order));
    const RunFlow large(run_layout({16, 12, 20}, 2, 2, order));
    const VisitClasses classes(small, telling_seconds(small));
    EXPECT_EQ(classes.draw(large, 1), telling_seconds(large));
  }
}

TEST(VisitClasses, TheSeedDecides) {
  const RunFlow flow(run_layout({8, 8, 8}, 2, 1, Order::kRaster));
  std::vector<double> seconds(flow.windows());
  for (std::size_t w = 0; w < seconds.size(); ++w) seconds[w] = static_cast<double>(w);
  const VisitClasses classes(flow, seconds);
  const auto drawn = classes.draw(flow, 1);
  EXPECT_EQ(drawn, classes.draw(flow, 1));
  EXPECT_NE(drawn, classes.draw(flow, 2));
  EXPECT_GT(std::set<double>(drawn.begin(), drawn.end()).size(), 100U);
}

TEST(VisitClasses, TakesTheNextClassWhereTheTraceHasNone) {
  const RunFlow one(run_layout({2, 2, 2}, 2, 1, Order::kRaster));
  const RunFlow many(run_layout({4, 4, 4}, 2, 1, Order::kRaster));
  const VisitClasses classes(one, {7.0});
  EXPECT_EQ(classes.draw(many, 1), std::vector<double>(many.windows(), 7.0));
  const RunFlow two_marches(run_layout({4, 4, 4}, 2, 2, Order::kRaster));
  EXPECT_THROW((void)classes.draw(two_marches, 1), Error);
}

TEST(VisitClasses, ATraceGoesToItsWindows) {
  const std::vector<MarchTrace> trace{{.windows = {3, 1, 1}, .seconds = {1.0, 2.0, 3.0}}};
  const RunFlow flow(traced_layout(trace, Order::kColour));
  EXPECT_EQ(traced_seconds(flow, trace), (std::vector<double>{1.0, 3.0, 2.0}));
  const std::vector<MarchTrace> torn{trace[0], {.windows = {2, 1, 1}, .seconds = {1.0, 1.0}}};
  EXPECT_THROW((void)traced_seconds(RunFlow(traced_layout(torn, Order::kColour)), torn), Error);
}

}  // namespace
}  // namespace mw::bench
