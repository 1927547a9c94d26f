// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5: the mesh does not depend on the number of threads, nor on how they are scheduled.
#include "tests/engine/march/watched_march.h"
#include "tests/engine/memory_run.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

constexpr std::array<int, 4> kThreads{2, 3, 4, 8};

/// Volumes of 20 to 130 windows, each with both orders and both start meshes.
template <typename Check>
void for_trials(std::uint32_t seed, std::size_t count, Check check) {
  std::mt19937 random(seed);
  constexpr std::array<Index3, 4> kShapes{{{12, 12, 12}, {20, 10, 8}, {9, 14, 11}, {16, 13, 5}}};
  for (std::size_t i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    Trial trial = random_trial(random, random_volume_of(random, kind, kShapes[i % kShapes.size()],
                                                        2 + static_cast<std::uint32_t>(i % 4)));
    trial.settings.window = 4;
    trial.settings.order = i % 2 == 0 ? Order::kRaster : Order::kColour;
    trial.settings.start = i / 2 % 2 == 0 ? StartMesh::kOctree : StartMesh::kDense;
    SCOPED_TRACE(trial.text());
    check(trial, random);
  }
}

TEST(Promise5SameBytes, ForEveryNumberOfThreads) {
  for_trials(211, 16, [](const Trial& trial, std::mt19937&) {
    const io::MeshData reference = run_in_memory(trial);
    for (int threads : kThreads) {
      expect_same(run_in_memory(trial, {.threads = threads}), reference);
    }
  });
}

TEST(Promise5SameBytes, ForTwentyRunsWithRandomDelays) {
  for_trials(212, 4, [](const Trial& trial, std::mt19937& random) {
    const io::MeshData reference = run_in_memory(trial);
    std::set<std::vector<std::array<std::int64_t, 4>>> completions;
    for (int run = 0; run < 20; ++run) {
      RandomDelay delay(below(random, 1000000), 2000);
      std::vector<std::array<std::int64_t, 4>> completed;
      RunHooks hooks{.threads = kThreads[static_cast<std::size_t>(run) % kThreads.size()]};
      hooks.before_visit = [&](Index3) { delay(); };
      hooks.trace = [&](const TraceEvent& e) {
        completed.push_back({e.march, e.window.x, e.window.y, e.window.z});
      };
      expect_same(run_in_memory(trial, hooks), reference);
      completions.insert(completed);
    }
    EXPECT_GT(completions.size(), 10U) << "the delays did not change the order of events";
  });
}

/// The two orders are two references: where windows overlap they may differ.
TEST(ColourOrder, HasItsOwnReference) {
  bool differ = false;
  std::mt19937 random(213);
  for (int i = 0; i < 4; ++i) {
    Trial trial =
        random_trial(random, random_volume_of(random, VolumeKind::kBlobs, {12, 12, 9}, 3));
    trial.settings.window = 4;
    trial.settings.order = Order::kRaster;
    const io::MeshData raster = run_in_memory(trial);
    trial.settings.order = Order::kColour;
    differ |= !(run_in_memory(trial).vertices == raster.vertices);
  }
  EXPECT_TRUE(differ);
}

TEST(MeshVolume, TracesEveryVisit) {
  std::mt19937 random(214);
  Trial trial = random_trial(random, random_volume_of(random, VolumeKind::kBlobs, {12, 9, 8}, 3));
  trial.settings.window = 4;
  trial.settings.marches = 2;
  for (int threads : {1, 3}) {
    std::set<std::vector<std::int64_t>> seen;
    RunHooks hooks{.threads = threads};
    hooks.trace = [&](const TraceEvent& e) {
      seen.insert({e.march, e.window.x, e.window.y, e.window.z});
      EXPECT_LE(0.0, e.start_seconds);
      EXPECT_LT(e.start_seconds, e.end_seconds);
      EXPECT_TRUE(e.slot >= 0 && e.slot < threads);
    };
    run_in_memory(trial, hooks);
    std::size_t windows = 0;
    for (int window : {4, 8}) {
      windows += static_cast<std::size_t>(WindowGrid({12, 9, 8}, window).windows().product());
    }
    EXPECT_EQ(seen.size(), windows);
  }
}

}  // namespace
}  // namespace mw::engine
