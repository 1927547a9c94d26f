// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Work on many threads, whose results are taken one after the other.
#pragma once

#include <tbb/parallel_pipeline.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "engine/system/crew.h"

namespace mw::engine {

/// How many threads work, and how many results may be made or wait to be merged at a time.
struct WorkInOrder {
  int threads = 1;
  std::size_t at_once = 2 * static_cast<std::size_t>(threads);
};

/// Calls merge(i, work(i)) for i from 0 to count - 1.  Several threads call work; merge is called
/// by one thread at a time and in the order of i, whatever the number of threads.
/// REQUIRES: how.threads and how.at_once are positive.
/// Memory: how.at_once results.  ERRORS: what they throw; other calls may then be left out.
template <typename Result, typename Index>
void each_in_order(WorkInOrder how, Index count,
                   const std::type_identity_t<std::function<Result(Index)>>& work,
                   const std::type_identity_t<std::function<void(Index, Result&&)>>& merge) {
  if (how.threads == 1 || how.at_once == 1) {
    for (Index i = 0; i < count; ++i) merge(i, work(i));
    return;
  }
  struct Done {
    Index i = 0;
    Result result;
  };
  Index next = 0;
  const auto start = [&](tbb::flow_control& control) {
    if (next == count) control.stop();
    return next == count ? count : next++;
  };
  const auto finish = [&](std::shared_ptr<Done> done) { merge(done->i, std::move(done->result)); };
  const auto run = [&](Index i) { return std::make_shared<Done>(Done{i, work(i)}); };
  constexpr auto kInOrder = tbb::filter_mode::serial_in_order;
  constexpr auto kParallel = tbb::filter_mode::parallel;
  Crew(how.threads).run([&] {
    tbb::parallel_pipeline(how.at_once,
                           tbb::make_filter<void, Index>(kInOrder, start) &
                               tbb::make_filter<Index, std::shared_ptr<Done>>(kParallel, run) &
                               tbb::make_filter<std::shared_ptr<Done>, void>(kInOrder, finish));
  });
}

}  // namespace mw::engine
