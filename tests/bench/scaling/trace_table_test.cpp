// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Traces read back: durations by window, and refusal of what is not a whole trace.
#include "bench/scaling/trace_table.h"
#include "bench/scaling/layouts.h"
#include "bench/scaling/run_flow.h"
#include "bench/scaling/sleeping_run.h"
#include "engine/store/run_layout.h"
#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw::bench {
namespace {

using engine::Order;

constexpr const char* kNames = "march,x,y,z,start_s,end_s,cpu_s,slot,bytes\n";

std::vector<MarchTrace> read(const std::string& lines, Clock clock) {
  std::istringstream in(kNames + lines);
  return read_trace(in, clock);
}

TEST(TraceTable, GivesDurationsByWindow) {
  const std::string lines =
      "0,1,0,0,2.5,3.5,0.75,1,700\n"
      "0,0,0,0,1,1.5,0.25,0,500\n"
      "1,0,0,0,4,6,1.5,0,900\n";
  const auto wall = read(lines, Clock::kWall);
  ASSERT_EQ(wall.size(), 2U);
  EXPECT_EQ(wall[0].bytes, (std::vector<std::uint64_t>{500, 700}));
  EXPECT_EQ(wall[0].windows, (Index3{2, 1, 1}));
  EXPECT_EQ(wall[0].seconds, (std::vector<double>{0.5, 1.0}));
  EXPECT_EQ(wall[1].windows, (Index3{1, 1, 1}));
  EXPECT_EQ(wall[1].seconds, (std::vector<double>{2.0}));
  EXPECT_EQ(read(lines, Clock::kCpu)[0].seconds, (std::vector<double>{0.25, 0.75}));
}

TEST(TraceTable, RefusesWhatIsNotAWholeTrace) {
  EXPECT_THROW(read("0,1,0,0,2.5,3.5,0.75,0\n", Clock::kCpu), Error);
  EXPECT_THROW(read("0,1,zero,0,2.5,3.5,0.75,0,1\n", Clock::kCpu), Error);
  EXPECT_THROW(read("0,1,0,0,2.5,3.5,0.75,0,1\n", Clock::kCpu), Error) << "window 0,0,0 is missing";
}

// Ranks whose windows sleep visit all of them, and send what was foreseen.

/// What leaves a rank, without the output.
std::vector<std::uint64_t> foreseen(const RunFlow& flow, const engine::Partition& dealt,
                                    int ranks) {
  std::vector<std::uint64_t> out(static_cast<std::size_t>(ranks));
  for (std::uint32_t w = 0; w < flow.windows(); ++w) {
    const int from = dealt.rank_of(flow.key(w));
    for (std::uint32_t next : flow.next_users(w)) {
      if (next == RunFlow::kOutput || dealt.rank_of(flow.key(next)) == from) continue;
      ++out[static_cast<std::size_t>(from)];
    }
  }
  return out;
}

TEST(SleepingRun, SendsWhatWasForeseen) {
  for (Order order : {Order::kRaster, Order::kColour}) {
    const RunFlow flow(run_layout({4, 22, 22}, 2, 2, order));
    const std::vector<double> seconds(flow.windows(), 1e-5);
    for (int ranks : {1, 2, 5}) {
      const engine::Partition dealt = deal(flow, seconds, order, ranks);
      const Machines machines{.ranks = ranks, .cores = 2};
      const SleepingRun run = sleeping_run(flow, seconds, dealt, machines);
      EXPECT_EQ(run.parcels, foreseen(flow, dealt, ranks));
      EXPECT_GE(run.seconds, longest_path(flow, seconds)) << "nobody wakes too early";
    }
  }
}

// The tables of a run against the route itself.

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
