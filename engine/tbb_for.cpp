// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// oneTBB behind the loops that kernels lend out.
#include "engine/tbb_for.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace mw::engine {
namespace {

constexpr std::size_t kRangesAThread = 4;
constexpr std::size_t kShortestRange = 1024;

}  // namespace

void tbb_for(std::size_t n, const RangeBody& body) {
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  // TBB halves ranges that are longer than the grain, so those that it leaves are at least half.
  const std::size_t grain = std::max(2 * kShortestRange, n / (kRangesAThread * threads));
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, grain),
        [&](const tbb::blocked_range<std::size_t>& r) { body(r.begin(), r.end()); },
        tbb::simple_partitioner());
  });
}

}  // namespace mw::engine
