// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5: the mesh does not depend on the order in which ready windows run.
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

/// First ready, first run.  The span is in no order of age, so ages are kept here.
class OldestFirst {
 public:
  std::size_t operator()(std::span<const Index3> ready) {
    std::size_t oldest = 0;
    for (std::size_t i = 1; i < ready.size(); ++i) {
      if (age(ready[i]) < age(ready[oldest])) oldest = i;
    }
    return oldest;
  }

 private:
  std::size_t age(Index3 w) {
    const std::array<std::int64_t, 3> key{w.x, w.y, w.z};
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (seen_[i] == key) return i;
    }
    seen_.push_back(key);
    return seen_.size() - 1;
  }

  std::vector<std::array<std::int64_t, 3>> seen_;
};

/// Picks the window that is last in raster order.
std::size_t pick_last(std::span<const Index3> ready) {
  const auto less = [](Index3 a, Index3 b) {
    return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
  };
  return static_cast<std::size_t>(std::max_element(ready.begin(), ready.end(), less) -
                                  ready.begin());
}

std::size_t pick_newest(std::span<const Index3> ready) {
  return ready.size() - 1;
}

void expect_order_independent(const Trial& trial, int random_orders, std::mt19937& random) {
  SCOPED_TRACE(trial.text());
  const io::MeshData reference = run_in_memory(trial);
  expect_same(run_in_memory(trial), reference);
  expect_same(run_in_memory(trial, {.progress = {}, .pick = pick_newest}), reference);
  expect_same(run_in_memory(trial, {.progress = {}, .pick = pick_last}), reference);
  expect_same(run_in_memory(trial, {.progress = {}, .pick = OldestFirst()}), reference);
  const PickReady any = [&](std::span<const Index3> ready) {
    return below(random, static_cast<std::uint32_t>(ready.size()));
  };
  for (int i = 0; i < random_orders; ++i) {
    expect_same(run_in_memory(trial, {.progress = {}, .pick = any}), reference);
  }
}

TEST(Promise5SameBytes, ForEveryOrderOfWindows) {
  std::mt19937 random(201);
  constexpr std::array<Index3, 12> kShapes{{{20, 5, 4},
                                            {9, 10, 11},
                                            {13, 9, 6},
                                            {5, 17, 5},
                                            {12, 12, 12},
                                            {4, 6, 19},
                                            {11, 11, 7},
                                            {20, 10, 2},
                                            {16, 13, 1},
                                            {10, 7, 12},
                                            {14, 14, 5},
                                            {18, 11, 9}}};
  for (std::size_t i = 0; i < kShapes.size() && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    Trial trial = random_trial(
        random, random_volume_of(random, kind, kShapes[i], 1 + static_cast<std::uint32_t>(i % 5)));
    trial.settings.window = i % 2 == 0 ? 4 : i % 4 == 1 ? 6 : 8;
    trial.settings.order = i % 3 == 2 ? Order::kColour : Order::kRaster;
    expect_order_independent(trial, 20, random);
  }
}

/// The hook is asked, and windows do run in other orders than raster.
TEST(Promise5SameBytes, OrdersDoDiffer) {
  const WindowOrder windows(WindowGrid({16, 12, 12}, 4), Order::kRaster);
  std::mt19937 random(202);
  const PickReady any = [&](std::span<const Index3> ready) {
    return below(random, static_cast<std::uint32_t>(ready.size()));
  };
  std::set<std::vector<std::size_t>> orders;
  for (int i = 0; i < 50; ++i) {
    std::vector<std::size_t> order;
    march_by_choice(
        windows, [&](Index3 w) { order.push_back(windows.rank(w)); }, any);
    EXPECT_EQ(order.size(), windows.size());
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 50U);
}

}  // namespace
}  // namespace mw::engine
