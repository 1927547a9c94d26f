// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whole runs with constrained ODT: the promises, for any number of threads and whatever befalls the
// workers.
#include "tests/engine/codt/random_plcs.h"
#include "tests/engine/memory_run.h"
#include "tests/expect_error.h"
#include "tests/promises/whole_runs.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using codt::test::has_worker;
using namespace test;

#define NEEDS_WORKER() \
  if (!has_worker()) GTEST_SKIP() << "built without TetGen"

struct Outcome {
  io::MeshData mesh;
  RunReport report;
};

Outcome run(const Trial& trial, int threads = 1,
            const codt::PoolOptions& workers = {.program = MW_CODT_WORKER}) {
  MemorySink sink;
  RunReport report = run_into(sink, trial, {.threads = threads, .workers = workers});
  return {sink.mesh(), std::move(report)};
}

/// Settings at random, but with CODT; every kind of volume in turn.
Trial codt_trial(std::mt19937& random, int number, std::int64_t edge) {
  const auto kind =
      static_cast<VolumeKind>(static_cast<std::uint32_t>(number) % audit::test::kVolumeKinds);
  const Index3 shape{edge, edge - below(random, 3), edge - below(random, 3)};
  Trial trial = random_trial(random, random_volume_of(random, kind, shape, 1 + below(random, 5)));
  trial.settings.optimizer = Optimizer::kTetgen;
  trial.settings.marches = 1 + static_cast<int>(below(random, 2));
  trial.settings.odt_iterations = 1 + static_cast<int>(below(random, 3));
  if (number % 3 == 0) trial.settings.quality_floor = 0.0;
  return trial;
}

/// P3 where the start mesh reaches the floor.
void expect_promises_of(const Trial& trial, const SmallMesh& mesh) {
  expect_same_topology(trial.volume, mesh, Counter::kAudit);
  expect_valid(trial, mesh);
  if (trial.settings.start == StartMesh::kOctree && trial.settings.quality_floor > 0.25) return;
  expect_floor(trial, mesh);
}

TEST(CodtRun, KeepsThePromises) {
  NEEDS_WORKER();
  std::mt19937 random(1401);
  CodtStats stats;
  for (int i = 0; i < 48 && !HasFailure(); ++i) {
    const Trial trial = codt_trial(random, i, 9);
    SCOPED_TRACE(trial.text());
    const Outcome out = run(trial);
    expect_promises_of(trial, small_mesh(out.mesh));
    stats += out.report.codt;
  }
  EXPECT_GT(stats.moves, 1000U);
  EXPECT_GT(stats.replaced.patches, 1000U);
  EXPECT_LT(stats.fallbacks, stats.windows / 20);
}

/// The planes where a cell repeats itself are facets, as interfaces are.
TEST(CodtRun, KeepsThePromisesOfCellsThatRepeatThemselves) {
  NEEDS_WORKER();
  std::mt19937 random(1409);
  CodtStats stats;
  for (int i = 0; i < 24 && !HasFailure(); ++i) {
    Trial trial = codt_trial(random, i, 10);
    trial.settings.edge_variance.reset();
    trial.settings.target_reduction.reset();
    trial.settings.periodic = 1 + below(random, 7);
    SCOPED_TRACE(trial.text() + " axes " + std::to_string(trial.settings.periodic));
    const Outcome out = run(trial);
    expect_promises_of(trial, small_mesh(out.mesh));
    expect_same(run(trial, 3).mesh, out.mesh);
    stats += out.report.codt;
  }
  EXPECT_GT(stats.replaced.patches, 300U);
}

TEST(CodtRun, SameBytesForEveryNumberOfThreads) {
  NEEDS_WORKER();
  std::mt19937 random(1402);
  for (int i = 0; i < 8 && !HasFailure(); ++i) {
    Trial trial = codt_trial(random, i, 11);
    trial.settings.window = i % 2 == 0 ? 4 : 8;
    SCOPED_TRACE(trial.text());
    const Outcome reference = run(trial, 1);
    for (int threads : {2, 4}) expect_same(run(trial, threads).mesh, reference.mesh);
  }
}

/// Points that a triangulation adds get ids that no other window gives, and the march carries them
/// on.
TEST(CodtRun, KeepsThePromisesWithSteinerPoints) {
  NEEDS_WORKER();
  std::mt19937 random(1406);
  std::uint64_t added = 0;
  for (int i = 0; i < 16 && !HasFailure(); ++i) {
    Trial trial = codt_trial(random, i, 10);
    trial.settings.window = i % 2 == 0 ? 4 : 8;
    trial.settings.quality_floor = i % 3 == 0 ? 0.0 : 0.02;
    SCOPED_TRACE(trial.text());
    const codt::PoolOptions splitting{.program = MW_SPLITTING_WORKER};
    const Outcome out = run(trial, 1, splitting);
    expect_promises_of(trial, small_mesh(out.mesh));
    expect_same(run(trial, 3, splitting).mesh, out.mesh);
    added += out.report.codt.added;
  }
  EXPECT_GT(added, 500U);
}

/// A worker program that a shell starts.
class Script {
 public:
  explicit Script(const std::string& lines) : path_(folder_.path() / "worker") {
    std::ofstream(path_) << "#!/bin/sh\n" << lines << "\n";
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] codt::PoolOptions options(int patience_ms = 20'000) const {
    return {.program = path_, .patience = std::chrono::milliseconds(patience_ms)};
  }

 private:
  mw::test::TempFolder folder_;
  std::filesystem::path path_;
};

TEST(CodtRun, KilledWorkersChangeNoByte) {
  NEEDS_WORKER();
  // Each worker is killed from outside some time after its start, which is too soon for some.
  const Script mortal(
      "(exec 3>&-; sleep $(($$ % 5 / 2)).1; kill -KILL $$) &\nexec " MW_CODT_WORKER);
  std::mt19937 random(1403);
  std::uint64_t restarted = 0;
  for (int i = 0; i < 6 && !HasFailure(); ++i) {
    Trial trial = codt_trial(random, i, 14);
    trial.settings.window = 6;
    SCOPED_TRACE(trial.text());
    const Outcome calm = run(trial), stormy = run(trial, 2, mortal.options());
    restarted += stormy.report.workers->restarted;
    expect_promises_of(trial, small_mesh(stormy.mesh));
    EXPECT_EQ(stormy.report.codt.fallbacks, calm.report.codt.fallbacks);
    expect_same(stormy.mesh, calm.mesh);
  }
  EXPECT_GT(restarted, 0U);
}

void expect_fallbacks(const codt::PoolOptions& workers, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int i = 0; i < 3; ++i) {
    Trial trial = codt_trial(random, i, 8);
    trial.settings.window = 8;
    SCOPED_TRACE(trial.text());
    const Outcome out = run(trial, 2, workers);
    EXPECT_EQ(out.report.codt.fallbacks, out.report.codt.windows);
    EXPECT_GE(out.report.codt.windows, 1U);
    EXPECT_EQ(out.report.workers->failed, out.report.codt.windows);
    expect_promises_of(trial, small_mesh(out.mesh));
    expect_same(run(trial, 1, workers).mesh, out.mesh);
  }
}

TEST(CodtRun, WorkersThatCrashCostTheirWindowsCodtOnly) {
  const Script crashing("kill -SEGV $$");
  expect_fallbacks(crashing.options(), 1404);
}

/// An out-of-memory killer must not choose the mesh.
TEST(CodtRun, WorkersThatAreKilledEndTheRun) {
  const Script killed("kill -KILL $$");
  std::mt19937 random(1405);
  Trial trial = codt_trial(random, 0, 8);
  trial.settings.window = 8;
  expect_error(ErrorKind::kResource, {"--optimizer tetgen", "ended by signal 9"},
               [&] { static_cast<void>(run(trial, 2, killed.options())); });
}

}  // namespace
}  // namespace mw::engine
