// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The budget: sums by purpose, peaks, refusals; many threads at once do not exceed the limit.
#include "engine/store/memory_budget.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>
#include <vector>

#include "kernels/core/error.h"

namespace mw::engine {
namespace {

using Reservation = MemoryBudget::Reservation;

TEST(MemoryBudget, AccountsByPurposeAndRemembersPeaks) {
  MemoryBudget budget(100);
  {
    const Reservation blocks = budget.reserve(Purpose::kBlocks, 30);
    const Reservation window = budget.reserve(Purpose::kWindows, 50);
    EXPECT_EQ(budget.used(), 80U);
    EXPECT_EQ(budget.used(Purpose::kBlocks), 30U);
    EXPECT_FALSE(budget.try_reserve(Purpose::kOutput, 21));
    EXPECT_TRUE(budget.try_reserve(Purpose::kOutput, 20));
    EXPECT_EQ(budget.used(Purpose::kOutput), 0U);
  }
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_EQ(budget.peak(), 100U);
  EXPECT_EQ(budget.peak(Purpose::kBlocks), 30U);
  EXPECT_EQ(budget.peak(Purpose::kWindows), 50U);
  EXPECT_EQ(budget.peak(Purpose::kOutput), 20U);
}

TEST(MemoryBudget, ReservationsMove) {
  MemoryBudget budget(10);
  Reservation a = budget.reserve(Purpose::kWindows, 4);
  Reservation b = std::move(a);
  EXPECT_EQ(budget.used(), 4U);
  a = budget.reserve(Purpose::kWindows, 5);
  EXPECT_EQ(budget.used(), 9U);
  b = std::move(a);
  EXPECT_EQ(budget.used(), 5U);
  EXPECT_EQ(b.bytes(), 5U);
  b = Reservation();
  EXPECT_EQ(budget.used(), 0U);
}

TEST(MemoryBudget, CarvesWithoutAskingForMore) {
  MemoryBudget budget(100);
  Reservation window = budget.reserve(Purpose::kWindows, 100);
  {
    const Reservation block = budget.carve(window, Purpose::kBlocks, 30);
    EXPECT_EQ(block.bytes(), 30U);
    EXPECT_EQ(window.bytes(), 70U);
    EXPECT_EQ(budget.used(Purpose::kBlocks), 30U);
    EXPECT_EQ(budget.used(), 100U);
    window = Reservation();
    EXPECT_EQ(budget.used(), 30U);
  }
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_EQ(budget.peak(), 100U);
}

TEST(MemoryBudget, SaysTheLeastThatWorks) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  MemoryBudget budget(10 * kMebibyte);
  const Reservation index = budget.reserve(Purpose::kIndex, 3 * kMebibyte);
  const Reservation blocks = budget.reserve(Purpose::kBlocks, 5 * kMebibyte);
  EXPECT_EQ(budget.min_with(8 * kMebibyte), 11 * kMebibyte);
  try {
    (void)budget.reserve(Purpose::kWindows, 8 * kMebibyte - 1);
    ADD_FAILURE() << "more than the limit";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kResource);
    EXPECT_NE(std::string(e.what()).find("--memory 11MiB"), std::string::npos) << e.what();
  }
}

TEST(MemoryBudget, HoldsUnderManyThreads) {
  MemoryBudget budget(1000);
  std::atomic<std::uint64_t> held = 0;
  std::atomic<bool> over = false;
  const auto work = [&](unsigned seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < 5000; ++i) {
      const std::uint64_t bytes = random() % 600;
      const auto r = budget.try_reserve(static_cast<Purpose>(random() % kPurposes), bytes);
      if (!r) continue;
      if (held += bytes; held > 1000) over = true;
      held -= bytes;
    }
  };
  std::vector<std::thread> threads;
  for (unsigned seed = 1; seed <= 4; ++seed) threads.emplace_back(work, seed);
  for (std::thread& t : threads) t.join();
  EXPECT_FALSE(over);
  EXPECT_EQ(budget.used(), 0U);
  EXPECT_LE(budget.peak(), 1000U);
}

}  // namespace
}  // namespace mw::engine
