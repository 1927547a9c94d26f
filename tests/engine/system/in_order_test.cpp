// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Results are taken in one by one and in order, however long the work on each takes.
#include "engine/system/in_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mw::engine {
namespace {

TEST(InOrder, TakesEveryResultOnceInOrder) {
  for (const int threads : {1, 2, 3, 8}) {
    for (const std::uint32_t count : {0U, 1U, 5U, 200U}) {
      std::vector<std::uint32_t> seen;
      each_in_order<std::uint32_t>(
          {.threads = threads}, count,
          [](std::uint32_t i) {
            std::this_thread::sleep_for(std::chrono::microseconds(i * 7919 % 300));
            return i * i;
          },
          [&](std::uint32_t i, std::uint32_t&& square) {
            EXPECT_EQ(square, i * i);
            seen.push_back(i);
          });
      std::vector<std::uint32_t> all(count);
      std::iota(all.begin(), all.end(), 0U);
      EXPECT_EQ(seen, all) << threads;
    }
  }
}

TEST(InOrder, TakesItemsInTurnUntilThereAreNone) {
  for (const int threads : {1, 2, 8}) {
    std::vector<int> next{3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5}, seen;
    const std::vector<int> all = next;
    const auto take = [&]() -> std::optional<int> {
      if (next.empty()) return std::nullopt;
      const int item = next.front();
      next.erase(next.begin());
      return item;
    };
    items_in_order<int, std::vector<int>>(
        {.threads = threads}, take,
        [](int&& item) {
          std::this_thread::sleep_for(std::chrono::microseconds(100 * item));
          return std::vector<int>{item};
        },
        [&](std::vector<int>&& result) { seen.push_back(result.at(0)); });
    EXPECT_EQ(seen, all) << threads;
  }
}

/// A result counts from before the work on it begins until it is taken in.
TEST(InOrder, HoldsNoMoreResultsThanItMay) {
  for (const std::size_t at_once : {1U, 2U, 3U, 9U}) {
    std::atomic<std::size_t> held = 0, most = 0;
    each_in_order<int>(
        {.threads = 4, .at_once = at_once}, 100U,
        [&](unsigned i) {
          const std::size_t now = ++held;
          std::size_t before = most;
          while (before < now && !most.compare_exchange_weak(before, now)) {
          }
          std::this_thread::sleep_for(std::chrono::microseconds(i % 5 == 0 ? 400 : 20));
          return 0;
        },
        [&](unsigned, int&&) { --held; });
    EXPECT_LE(most, at_once);
    EXPECT_EQ(held, 0U);
  }
}

TEST(InOrder, PassesErrorsOn) {
  for (const int threads : {1, 4}) {
    std::uint64_t taken = 0;
    const auto take = [&](std::uint64_t i, int&&) {
      EXPECT_EQ(i, taken++);
      if (i == 30) throw std::range_error("full");
    };
    const auto work = [](std::uint64_t) { return 0; };
    const auto failing = [](std::uint64_t i) {
      if (i == 20) throw std::runtime_error("damaged");
      return 0;
    };
    EXPECT_THROW(each_in_order<int>({.threads = threads}, std::uint64_t{100}, work, take),
                 std::range_error);
    EXPECT_EQ(taken, 31U);
    taken = 0;
    EXPECT_THROW(each_in_order<int>({.threads = threads}, std::uint64_t{100}, failing, take),
                 std::runtime_error);
    EXPECT_LE(taken, 20U);
  }
}

}  // namespace
}  // namespace mw::engine
