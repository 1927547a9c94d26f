// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes tasks of ranges of a given size, and of parts of an array.
#include "engine/system/tbb_for.h"

#include <tbb/blocked_range.h>
#include <tbb/blocked_range3d.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "engine/system/crew.h"
#include "kernels/core/index.h"

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

void tbb_for_each_index(int threads, Index3 shape, const std::function<void(Index3)>& visit) {
  if (threads == 1) {
    for_each_index(shape, visit);
    return;
  }
  using Part = tbb::blocked_range3d<std::int64_t>;
  Crew(threads).run([&] {
    tbb::parallel_for(Part(0, shape.z, 0, shape.y, 0, shape.x), [&](const Part& part) {
      for_each_index(Box3{{part.cols().begin(), part.rows().begin(), part.pages().begin()},
                          {part.cols().end(), part.rows().end(), part.pages().end()}},
                     visit);
    });
  });
}

}  // namespace mw::engine
