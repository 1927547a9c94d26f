// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Ranks whose windows sleep visit all of them, and send what was foreseen.
#include "bench/scaling/sleeping_run.h"

#include <gtest/gtest.h>

#include "bench/scaling/layouts.h"

namespace mw::bench {
namespace {

using engine::Order;

/// Returns for each rank how many blocks leave it before the output.
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

}  // namespace
}  // namespace mw::bench
