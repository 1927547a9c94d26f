// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Work on many threads, whose results are taken one after the other.
#pragma once

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "engine/system/crew.h"
#include "engine/system/stages.h"

namespace mw::engine {

/// How many threads work, and how many results may be made or wait to be merged at a time.
struct WorkInOrder {
  int threads = 1;
  std::size_t at_once = 2 * static_cast<std::size_t>(threads);

  /// Returns the work of this many threads on items of `bytes_each` that fit into `bytes`.
  [[nodiscard]] static WorkInOrder within(int threads, std::uint64_t bytes,
                                          std::uint64_t bytes_each) {
    const WorkInOrder most{.threads = threads};
    return {.threads = threads,
            .at_once = std::clamp<std::size_t>(bytes / bytes_each, 1, most.at_once)};
  }
  /// True if one thread does all.
  [[nodiscard]] bool is_alone() const { return threads == 1 || at_once == 1; }
};

/// Calls merge(work(item)) for each item that take() returns, until it returns none.  Several
/// threads call work; take and merge are each called by one thread at a time and in the order of
/// the items, but take may run while merge does. REQUIRES: how.threads and how.at_once are
/// positive. Memory: how.at_once items and results.  ERRORS: what they throw; other calls may then
/// be left out.
template <typename Item, typename Result>
void items_in_order(WorkInOrder how,
                    const std::type_identity_t<std::function<std::optional<Item>()>>& take,
                    const std::type_identity_t<std::function<Result(Item&&)>>& work,
                    const std::type_identity_t<std::function<void(Result&&)>>& merge) {
  const auto shared = [&](Item&& item) {
    const SharedWork counted;
    return work(std::move(item));
  };
  if (how.is_alone()) {
    while (std::optional<Item> item = take()) merge(shared(std::move(*item)));
    return;
  }
  using SharedItem = std::shared_ptr<Item>;
  using SharedResult = std::shared_ptr<Result>;
  const auto start = [&](tbb::flow_control& control) {
    std::optional<Item> item = take();
    if (!item) control.stop();
    return item ? std::make_shared<Item>(std::move(*item)) : SharedItem();
  };
  const auto run = [&](const SharedItem& item) {
    return std::make_shared<Result>(shared(std::move(*item)));
  };
  const auto finish = [&](const SharedResult& result) { merge(std::move(*result)); };
  constexpr auto kInOrder = tbb::filter_mode::serial_in_order;
  constexpr auto kParallel = tbb::filter_mode::parallel;
  Crew(how.threads).run([&] {
    tbb::parallel_pipeline(how.at_once,
                           tbb::make_filter<void, SharedItem>(kInOrder, start) &
                               tbb::make_filter<SharedItem, SharedResult>(kParallel, run) &
                               tbb::make_filter<SharedResult, void>(kInOrder, finish));
  });
}

/// Calls merge(i, work(i)) for i from 0 to count - 1.  Several threads call work; merge is called
/// by one thread at a time and in the order of i, whatever the number of threads.
/// REQUIRES: how.threads and how.at_once are positive.
/// Memory: how.at_once results.  ERRORS: what they throw; other calls may then be left out.
template <typename Result, typename Index>
void each_in_order(WorkInOrder how, Index count,
                   const std::type_identity_t<std::function<Result(Index)>>& work,
                   const std::type_identity_t<std::function<void(Index, Result&&)>>& merge) {
  using Done = std::pair<Index, Result>;
  Index next = 0;
  const auto take = [&]() -> std::optional<Index> {
    return next == count ? std::nullopt : std::optional<Index>(next++);
  };
  items_in_order<Index, Done>(
      how, take,
      [&](Index&& i) {
        return Done{i, work(i)};
      },
      [&](Done&& done) { merge(done.first, std::move(done.second)); });
}

}  // namespace mw::engine
