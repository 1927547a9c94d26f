// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Ranks as threads.
#pragma once

#include <thread>

#include "engine/team/team.h"
#include "tests/engine/team/thread_exchange.h"
#include "tests/testing.h"

namespace mw::engine::test {

/// Runs `rank` on every rank at once, and waits for all.
inline void for_ranks(const ThreadExchangeOptions& options,
                      const std::function<void(Team& team)>& rank) {
  const auto exchanges = thread_exchanges(options);
  std::vector<std::thread> threads;
  for (const auto& exchange : exchanges) {
    threads.emplace_back([&rank, &exchange] {
      Team team(*exchange);
      rank(team);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace mw::engine::test
