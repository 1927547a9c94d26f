// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5: the mesh does not depend on how many processes share the run, nor on when their
// messages arrive.  Processes are played by threads here; those of MPI are in tests/mpi.
#include <gmock/gmock.h>

#include <numeric>

#include "engine/labels/prepared_labels.h"
#include "engine/run/run.h"
#include "engine/team/team_processes.h"
#include "engine/team/team_run.h"
#include "tests/engine/march/watched_march.h"
#include "tests/engine/memory_run.h"
#include "tests/engine/team/crowd.h"
#include "tests/expect_error.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

Trial trial_of(std::mt19937& random, std::size_t i, Index3 shape) {
  const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
  Trial trial = random_trial(
      random, random_volume_of(random, kind, shape, 2 + static_cast<std::uint32_t>(i % 4)));
  trial.settings.window = 4;
  trial.settings.order = i % 2 == 0 ? Order::kRaster : Order::kColour;
  return trial;
}

struct Shared {
  io::MeshData mesh;
  RunReport report;
};

/// hooks: of every rank.
Shared run_shared(const Trial& trial, const ThreadExchangeOptions& options,
                  const RunHooks& hooks = {}) {
  Shared out;
  for_ranks(options, [&](Team& team) {
    TeamProcesses processes(team);
    test::MemorySink sink;
    RunHooks own = hooks;
    own.processes = &processes;
    const RunReport report = run_into(sink, trial, own);
    if (!team.is_first()) return;
    out = {sink.mesh(), report};
  });
  return out;
}

TEST(Promise5SameBytes, ForEveryNumberOfProcesses) {
  std::mt19937 random(311);
  constexpr std::array<Index3, 4> kShapes{{{12, 12, 12}, {20, 10, 8}, {9, 14, 11}, {6, 30, 18}}};
  for (std::size_t i = 0; i < 24 && !::testing::Test::HasFailure(); ++i) {
    const Trial trial = trial_of(random, i, kShapes[i % kShapes.size()]);
    SCOPED_TRACE(trial.text());
    RunHooks hooks;
    if (i % 4 == 1) {
      hooks.output.wanted = [](RawLabel label) { return test::test_label(label) > 1; };
    }
    const io::MeshData reference = run_in_memory(trial, hooks);
    for (int ranks : {1, 2, 3, 4, 8}) {
      hooks.threads = 1 + static_cast<int>(below(random, 3));
      const ThreadExchangeOptions options{
          .ranks = ranks,
          .seed = static_cast<std::uint32_t>(i),
          .max_delay = std::chrono::microseconds(i % 3 == 0 ? 5000 : 100)};
      expect_same(run_shared(trial, options, hooks).mesh, reference);
    }
  }
}

/// A cell that repeats itself: grids of later marches begin at other blocks.
TEST(Promise5SameBytes, OfACellThatRepeatsItselfForEveryNumberOfProcesses) {
  std::mt19937 random(319);
  constexpr std::array<Index3, 3> kShapes{{{12, 12, 12}, {20, 10, 8}, {8, 24, 18}}};
  for (std::size_t i = 0; i < 12 && !::testing::Test::HasFailure(); ++i) {
    Trial trial = trial_of(random, i, kShapes[i % kShapes.size()]);
    trial.settings.edge_variance.reset();
    trial.settings.target_reduction.reset();
    trial.settings.periodic = 1 + below(random, 7);
    SCOPED_TRACE(trial.text());
    const io::MeshData reference = run_in_memory(trial);
    for (int ranks : {1, 2, 3, 5}) {
      const RunHooks hooks{.threads = 1 + static_cast<int>(below(random, 3))};
      const ThreadExchangeOptions options{.ranks = ranks,
                                          .seed = static_cast<std::uint32_t>(i),
                                          .max_delay = std::chrono::microseconds(100)};
      expect_same(run_shared(trial, options, hooks).mesh, reference);
    }
  }
}

/// What the routes of this run say.
std::vector<std::uint64_t> predicted_blocks(const Trial& trial, int ranks) {
  const test::MemoryVolume volume(trial.volume, trial.frame);
  const io::LabelTable table = io::collect_labels(volume);
  const PreparedLabels labels(io::DenseVolume(volume, table), trial.settings);
  std::vector<WindowGrid> grids;
  for (int i = 0; i < trial.settings.marches; ++i) {
    grids.emplace_back(trial.volume.shape, trial.settings.window << i);
  }
  const RunLayout layout(grids, trial.settings.order);
  std::vector<std::uint64_t> out;
  for_ranks({.ranks = ranks}, [&](Team& team) {
    const Partition partition = deal_windows(team, layout, trial.settings, labels.counts().faces);
    if (team.is_first()) out = blocks_sent(layout, partition, ranks);
  });
  return out;
}

/// All ranks visit each window once, between them, and send what the routes say.
TEST(Promise5SameBytes, ProcessesShareTheWorkAndSendWhatIsPredicted) {
  std::mt19937 random(312);
  for (std::size_t i = 0; i < 8; ++i) {
    const Trial trial = trial_of(random, i, {10, 24, 22});
    RunReport alone;
    {
      test::MemorySink sink;
      alone = run_into(sink, trial);
    }
    constexpr int kRanks = 4;
    const RunReport shared = run_shared(trial, {.ranks = kRanks}).report;
    EXPECT_EQ(shared.windows, alone.windows);
    EXPECT_EQ(shared.vertices, alone.vertices);
    const std::vector<std::uint64_t> predicted = predicted_blocks(trial, kRanks);
    std::vector<std::uint64_t> sent;
    std::uint64_t windows = 0;
    for (const ProcessFacts& rank : shared.processes) {
      sent.push_back(rank.blocks_sent);
      windows += rank.windows;
    }
    EXPECT_EQ(sent, predicted);
    EXPECT_EQ(windows, alone.windows);
    EXPECT_GT(std::accumulate(sent.begin(), sent.end(), std::uint64_t{0}), 0U);
  }
}

/// A mesh that cannot be finished.
class FailingSink : public io::NoSink {
  void finish() override { throw Error(ErrorKind::kResource, "the disk is full"); }
};

/// The others have left their blocks and wait.
TEST(Promise5SameBytes, AFailedOutputEndsAll) {
  std::mt19937 random(318);
  const Trial trial = trial_of(random, 1, {12, 24, 20});
  std::atomic<int> told = 0;
  for_ranks({.ranks = 3, .seed = 10, .max_delay = std::chrono::microseconds(500)}, [&](Team& team) {
    TeamProcesses processes(team);
    FailingSink sink;
    expect_error(ErrorKind::kResource, {"the disk is full"},
                 [&] { (void)run_into(sink, trial, {.processes = &processes}); });
    ++told;
  });
  EXPECT_EQ(told, 3);
}

/// A rank that fails ends all of them with its error.
TEST(Promise5SameBytes, AFailedProcessEndsTheRun) {
  std::mt19937 random(313);
  const Trial trial = trial_of(random, 1, {12, 24, 20});
  for (int failing : {0, 2}) {
    std::atomic<int> told = 0;
    for_ranks({.ranks = 3, .seed = 9, .max_delay = std::chrono::microseconds(500)},
              [&](Team& team) {
                TeamProcesses processes(team);
                test::MemorySink sink;
                RunHooks hooks{.threads = 2, .processes = &processes};
                std::atomic<int> visits = 0;
                if (team.rank() == failing) {
                  hooks.before_visit = [&](Index3) {
                    if (++visits == 5) throw Error(ErrorKind::kResource, "rank is tired");
                  };
                }
                try {
                  (void)run_into(sink, trial, hooks);
                  ADD_FAILURE() << "rank " << team.rank() << " thinks that all is well";
                } catch (const Error& error) {
                  EXPECT_EQ(error.kind(), ErrorKind::kResource);
                  EXPECT_THAT(error.what(), ::testing::EndsWith("rank is tired"));
                  ++told;
                }
              });
    EXPECT_EQ(told, 3);
  }
}

TEST(Promise5SameBytes, ProcessesThatWereToldOtherThingsRefuse) {
  std::mt19937 random(314);
  const Trial trial = trial_of(random, 0, {8, 8, 8});
  for_ranks({.ranks = 3}, [&](Team& team) {
    TeamProcesses processes(team);
    const test::MemoryVolume volume(trial.volume, trial.frame);
    const io::LabelTable table = io::collect_labels(volume);
    test::MemorySink sink;
    MeshSettings settings = trial.settings;
    if (team.rank() == 2) settings.quality_floor += 0.01;
    expect_error(ErrorKind::kUsage, {"rank 2 has 'quality-floor"}, [&] {
      (void)mesh_volume(io::DenseVolume(volume, table), settings, sink, {.processes = &processes});
    });
  });
}

}  // namespace
}  // namespace mw::engine
