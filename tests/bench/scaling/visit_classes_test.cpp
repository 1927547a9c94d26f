// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Durations of larger runs come from windows of the same class.
#include "bench/scaling/visit_classes.h"

#include <gtest/gtest.h>

#include <set>

#include "bench/scaling/layouts.h"
#include "kernels/core/error.h"

namespace mw::bench {
namespace {

using engine::Order;

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
