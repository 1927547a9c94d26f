// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5: the mesh does not depend on how many processes share the run, nor on when their
// messages arrive.  Processes are played by threads here; those of MPI are in tests/mpi.
#include <gmock/gmock.h>

#include "engine/labels/prepared_labels.h"
#include "engine/run/run.h"
#include "engine/team/team_processes.h"
#include "engine/team/team_run.h"
#include "io/mesh/open_mesh.h"
#include "tests/engine/march/watched_march.h"
#include "tests/engine/memory_run.h"
#include "tests/engine/store/work_folder.h"
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
    const io::MeshData reference = run_in_memory(trial);
    for (int ranks : {1, 2, 3, 4, 8}) {
      const int threads = 1 + static_cast<int>(below(random, 3));
      const ThreadExchangeOptions options{
          .ranks = ranks,
          .seed = static_cast<std::uint32_t>(i),
          .max_delay = std::chrono::microseconds(i % 3 == 0 ? 5000 : 100)};
      expect_same(run_shared(trial, options, {.threads = threads}).mesh, reference);
    }
  }
}

/// What the routes of this run say.
std::vector<std::uint64_t> predicted_blocks(const Trial& trial, int ranks,
                                            FinalBlocksGo go = FinalBlocksGo::kToFirst) {
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
    if (team.is_first()) out = blocks_sent(layout, partition, ranks, go);
  });
  return out;
}

/// Writes the mesh into a .vtkhdf: all ranks do.  Returns what rank 0 reports.
RunReport write_shared(const Trial& trial, const ThreadExchangeOptions& options,
                       const std::filesystem::path& path, const RunHooks& hooks = {}) {
  RunReport out;
  for_ranks(options, [&](Team& team) {
    TeamProcesses processes(team);
    test::MemorySink unused;
    const auto mesh = io::open_shared_mesh(path);
    if (team.is_first()) mesh->create();
    RunHooks own = hooks;
    own.processes = &processes;
    own.together = mesh.get();
    const RunReport report = run_into(unused, trial, own);
    EXPECT_TRUE(report.written_together);
    if (team.is_first()) out = report;
  });
  return out;
}

RunReport write_alone(const Trial& trial, const std::filesystem::path& path,
                      const RunHooks& hooks = {}) {
  const auto sink = io::open_mesh_sink(path);
  return run_into(*sink, trial, hooks);
}

/// All that a mesh written together has.
void expect_same_figures(const RunReport& shared, const RunReport& alone) {
  EXPECT_EQ(shared.vertices, alone.vertices);
  EXPECT_EQ(shared.tets, alone.tets);
  EXPECT_EQ(shared.label_voxels, alone.label_voxels);
}

using WrittenTogether = test::FolderTest;

TEST_F(WrittenTogether, Promise5SameBytesForEveryNumberOfProcesses) {
  std::mt19937 random(315);
  constexpr std::array<Index3, 4> kShapes{{{12, 12, 12}, {20, 10, 8}, {9, 14, 11}, {6, 30, 18}}};
  for (std::size_t i = 0; i < 24 && !HasFailure(); ++i) {
    const Trial trial = trial_of(random, i, kShapes[i % kShapes.size()]);
    SCOPED_TRACE(trial.text());
    RunHooks hooks{.threads = 1 + static_cast<int>(below(random, 2))};
    if (i % 4 == 1) {
      hooks.output.wanted = [](RawLabel label) { return test::test_label(label) > 1; };
    }
    const RunReport alone = write_alone(trial, folder() / "alone.vtkhdf", hooks);
    for (int ranks : {2, 3, 4, 8}) {
      const ThreadExchangeOptions options{
          .ranks = ranks,
          .seed = static_cast<std::uint32_t>(i),
          .max_delay = std::chrono::microseconds(i % 3 == 0 ? 5000 : 100)};
      const RunReport report = write_shared(trial, options, folder() / "shared.vtkhdf", hooks);
      expect_same_figures(report, alone);
      EXPECT_TRUE(mw::test::content_of(folder() / "shared.vtkhdf") ==
                  mw::test::content_of(folder() / "alone.vtkhdf"))
          << ranks << " processes";
    }
  }
}

/// Where the last march leaves them: nothing is sent for the output.
TEST_F(WrittenTogether, FinalBlocksStay) {
  std::mt19937 random(316);
  for (std::size_t i = 0; i < 4; ++i) {
    const Trial trial = trial_of(random, i, {10, 24, 22});
    constexpr int kRanks = 4;
    const RunReport report = write_shared(trial, {.ranks = kRanks}, folder() / "shared.vtkhdf");
    std::vector<std::uint64_t> sent;
    for (const ProcessFacts& rank : report.processes) sent.push_back(rank.blocks_sent);
    EXPECT_EQ(sent, predicted_blocks(trial, kRanks, FinalBlocksGo::kToOwners));
    const auto to_first = predicted_blocks(trial, kRanks, FinalBlocksGo::kToFirst);
    EXPECT_LT(std::accumulate(sent.begin(), sent.end(), std::uint64_t{0}),
              std::accumulate(to_first.begin(), to_first.end(), std::uint64_t{0}));
  }
}

/// A mesh whose writing fails on one rank.
class FailingMesh : public io::SharedMesh {
 public:
  enum class When : std::uint8_t { kJoin, kRows, kSync, kFinish };

  FailingMesh(std::unique_ptr<io::SharedMesh> mesh, std::optional<When> when)
      : mesh_(std::move(mesh)), when_(when) {}

  void create() override { mesh_->create(); }
  [[nodiscard]] std::string place() const override { return mesh_->place(); }
  void join(const std::string& place) override {
    fail(When::kJoin);
    mesh_->join(place);
  }
  void lay_out(const io::MeshHeader& header, std::uint64_t vertices) override {
    mesh_->lay_out(header, vertices);
  }
  void begin(const io::MeshHeader& header) override { mesh_->begin(header); }
  void go_to(const io::RowPlace& rows) override { mesh_->go_to(rows); }
  void write_vertices(std::span<const io::Position> positions) override {
    mesh_->write_vertices(positions);
  }
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override {
    fail(When::kRows);
    mesh_->write_tets(tets, labels);
  }
  void sync() override {
    fail(When::kSync);
    mesh_->sync();
  }
  void finish() override {
    fail(When::kFinish);
    mesh_->finish();
  }
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return mesh_->buffer_bytes(); }

 private:
  void fail(When here) const {
    if (when_ == here) throw Error(ErrorKind::kResource, "the disk is full");
  }

  std::unique_ptr<io::SharedMesh> mesh_;
  std::optional<When> when_;
};

/// Returns how many ranks were told.
int ranks_told(const Trial& trial, int failing, FailingMesh::When when,
               const std::filesystem::path& path) {
  std::atomic<int> told = 0;
  const ThreadExchangeOptions options{
      .ranks = 3, .seed = 10, .max_delay = std::chrono::microseconds(500)};
  for_ranks(options, [&](Team& team) {
    TeamProcesses processes(team);
    test::MemorySink unused;
    FailingMesh mesh(io::open_shared_mesh(path),
                     team.rank() == failing ? std::optional(when) : std::nullopt);
    if (team.is_first()) mesh.create();
    try {
      (void)run_into(unused, trial, {.processes = &processes, .together = &mesh});
    } catch (const Error& error) {
      ++told;
      // To a rank that is told late the file may be gone already; rank 0, who speaks, knows why.
      if (!team.is_first() && team.rank() != failing) return;
      EXPECT_EQ(error.kind(), ErrorKind::kResource);
      EXPECT_THAT(error.what(), ::testing::EndsWith("the disk is full"));
    }
  });
  return told;
}

TEST_F(WrittenTogether, AFailedWriterEndsAllAndLeavesNothing) {
  using When = FailingMesh::When;
  // Rank 0 has made what the others join, and they give no names.
  constexpr std::array<std::pair<int, When>, 6> kFailures{{{2, When::kJoin},
                                                           {0, When::kRows},
                                                           {2, When::kRows},
                                                           {0, When::kSync},
                                                           {2, When::kSync},
                                                           {0, When::kFinish}}};
  std::mt19937 random(318);
  const Trial trial = trial_of(random, 1, {12, 24, 20});
  for (const auto& [failing, when] : kFailures) {
    EXPECT_EQ(ranks_told(trial, failing, when, folder() / "m.vtkhdf"), 3);
    EXPECT_TRUE(std::filesystem::is_empty(folder()));
  }
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
