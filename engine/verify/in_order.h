// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Work on one tile after the other, on many threads.
#pragma once

#include <tbb/parallel_pipeline.h>

#include <cstdint>
#include <functional>
#include <memory>

#include "engine/system/crew.h"

namespace mw::engine {

/// Calls merge(tile, work(tile)) for the tiles from 0 to count: work on that many threads, merge
/// on one at a time and in the order of the tiles, whatever the threads.
/// Memory: two results a thread.  ERRORS: what they throw.
template <typename Result>
void each_in_order(int threads, std::uint32_t count,
                   const std::function<Result(std::uint32_t)>& work,
                   const std::function<void(std::uint32_t, Result&&)>& merge) {
  struct Done {
    std::uint32_t tile = 0;
    Result result;
  };
  std::uint32_t next = 0;
  const auto start = [&](tbb::flow_control& control) {
    if (next == count) control.stop();
    return next == count ? count : next++;
  };
  const auto finish = [&](std::shared_ptr<Done> done) {
    merge(done->tile, std::move(done->result));
  };
  const auto run = [&](std::uint32_t tile) {
    return std::make_shared<Done>(Done{tile, work(tile)});
  };
  Crew crew(threads);
  crew.run([&] {
    tbb::parallel_pipeline(
        2 * static_cast<std::size_t>(crew.size()),
        tbb::make_filter<void, std::uint32_t>(tbb::filter_mode::serial_in_order, start) &
            tbb::make_filter<std::uint32_t, std::shared_ptr<Done>>(tbb::filter_mode::parallel,
                                                                   run) &
            tbb::make_filter<std::shared_ptr<Done>, void>(tbb::filter_mode::serial_in_order,
                                                          finish));
  });
}

}  // namespace mw::engine
