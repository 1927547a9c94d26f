// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5 across kills: a run that was killed at any instant goes on to the same mesh.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "engine/run/run.h"
#include "engine/team/team_processes.h"
#include "tests/engine/memory_run.h"
#include "tests/engine/store/work_folder.h"
#include "tests/engine/team/crowd.h"
#include "tests/expect_error.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;

using Seconds = std::chrono::duration<double>;

class ResumeTest : public test::FolderTest {
 protected:
  [[nodiscard]] StoreOptions options() const {
    return {.workdir = folder() / "work",
            .resume = true,
            .identity = {},
            .group = {.windows = 2, .age = std::chrono::hours(1)},
            .kept = {}};
  }
};

Trial trial_of(std::mt19937& random, VolumeKind kind) {
  return {.volume = random_volume_of(random, kind, {22, 18, 15}, 4),
          .settings = {.window = 6, .marches = 2},
          .frame = {}};
}

void expect_same(const io::MeshData& actual, const io::MeshData& expected) {
  EXPECT_TRUE(actual.vertices == expected.vertices);
  EXPECT_TRUE(actual.tets == expected.tets);
  EXPECT_TRUE(actual.labels == expected.labels);
}

RunHooks hooks_with(const StoreOptions& store) {
  RunHooks hooks;
  hooks.store = store;
  return hooks;
}

/// Runs in a child and kills it after a while; true when it was done before.
bool run_and_kill(const Trial& trial, const StoreOptions& store, Seconds after) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      run_in_memory(trial, hooks_with(store));
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  std::this_thread::sleep_for(after);
  ::kill(child, SIGKILL);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
  return WIFEXITED(status);
}

std::uint64_t resumed_windows(const Trial& trial, const StoreOptions& store,
                              const io::MeshData& expected) {
  test::MemorySink sink;
  const RunReport report = run_into(sink, trial, hooks_with(store));
  expect_same(sink.mesh(), expected);
  EXPECT_EQ(report.windows + report.store.resumed_windows,
            static_cast<std::uint64_t>(WindowGrid(trial.volume.shape, 6).windows().product() +
                                       WindowGrid(trial.volume.shape, 12).windows().product()));
  return report.store.resumed_windows;
}

/// Ten kills, or as many as MW_TEST_KILLS says; every third run is killed twice before it may end.
TEST_F(ResumeTest, Promise5SameBytesAfterKillsAtRandomInstants) {
  const char* more = std::getenv("MW_TEST_KILLS");  // NOLINT(concurrency-mt-unsafe)
  const int kills = more == nullptr ? 10 : std::atoi(more);
  std::mt19937 random(371);
  const Trial trial = trial_of(random, VolumeKind::kBlobs);
  const auto start = std::chrono::steady_clock::now();
  const io::MeshData expected = run_in_memory(trial);
  const Seconds whole = std::chrono::steady_clock::now() - start;
  int resumed = 0;
  for (int i = 0; i < kills; ++i) {
    const auto instant = [&] { return whole * (static_cast<double>(random() % 1200) / 1000.0); };
    const bool done = run_and_kill(trial, options(), instant());
    if (i % 3 == 0 && !done) run_and_kill(trial, options(), instant());
    if (resumed_windows(trial, options(), expected) > 0) ++resumed;
    EXPECT_FALSE(std::filesystem::exists(options().workdir));
  }
  EXPECT_GT(resumed, kills / 4);
}

struct Stop {};

/// The size that an error advises; 0 when there was none.
std::uint64_t advised_memory(const Trial& trial, const StoreOptions& store,
                             const io::MeshData& expected) {
  try {
    expect_same(run_in_memory(trial, hooks_with(store)), expected);
    return 0;
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kResource) << e.what();
    const std::string message = e.what();
    for (const std::string_view before : {"is less than ", "--memory "}) {
      const std::size_t at = message.find(before);
      if (at != std::string::npos) return std::stoull(message.substr(at + before.size())) << 20;
    }
    ADD_FAILURE() << message;
    return 0;
  }
}

/// A window that waits for memory must not wait for one that has failed, nor for those that were
/// let in and then not visited any more.
TEST_F(ResumeTest, EndsWhenAWindowFailsUnderATightBudget) {
  std::mt19937 random(374);
  const Trial trial = trial_of(random, VolumeKind::kNoise);
  StoreOptions store = options();
  store.resume = false;
  store.memory = 1;
  store.memory = advised_memory(trial, store, {});
  for (int i = 0; i < 16; ++i) {
    RunHooks hooks = hooks_with(store);
    hooks.threads = 2 + i % 7;
    std::atomic<int> visits = 0;
    hooks.before_visit = [&](Index3) {
      if (++visits > i % 10) throw Stop{};
    };
    EXPECT_ANY_THROW(run_in_memory(trial, hooks));
    std::filesystem::remove_all(store.workdir);
  }
}

/// Progress may stop a run after any window; what was done is saved and said to be.
TEST_F(ResumeTest, GoesOnAfterBeingStopped) {
  std::mt19937 random(372);
  for (int i = 0; i < 3; ++i) {
    const Trial trial = trial_of(random, static_cast<VolumeKind>(i));
    const io::MeshData expected = run_in_memory(trial);
    StoreOptions store = options();
    store.group.windows = 1'000'000;
    int kept = 0;
    store.kept = [&] { ++kept; };
    const std::uint64_t stop_at = 1 + random() % 60;
    RunHooks hooks = hooks_with(store);
    hooks.progress = [&](const RunProgress& at) {
      if (at.done == stop_at) throw Stop{};
    };
    EXPECT_THROW(run_in_memory(trial, hooks), Stop);
    EXPECT_EQ(kept, 1);
    EXPECT_EQ(resumed_windows(trial, store, expected), stop_at);
  }
}

/// From next to nothing by the advice of each error to the least that works, then plenty: the same
/// mesh, whatever was spilled or gone on with.
TEST_F(ResumeTest, Promise5SameBytesForEveryBudget) {
  std::mt19937 random(373);
  const Trial trial = trial_of(random, VolumeKind::kNoise);
  const io::MeshData expected = run_in_memory(trial);
  StoreOptions store = options();
  int refusals = 0;
  std::uint64_t before = 0;
  for (store.memory = 1; store.memory > 0;) {
    EXPECT_GT(store.memory, before) << "an advice that is no use";
    before = store.memory;
    store.memory = advised_memory(trial, store, expected);
    if (store.memory > 0) ++refusals;
  }
  EXPECT_GE(refusals, 1);
  store.memory = 100 * before;
  EXPECT_EQ(advised_memory(trial, store, expected), 0U);
}

// Promise 7 with several processes: a run in which one fails at any window goes on from its last
// epoch, with any number of processes, to the mesh of one process.  Processes are threads here;
// tests/mpi kills real ones.

struct Attempt {
  int ranks = 1;
  int threads = 1;
  std::uint64_t fails_after = 0;  ///< visits of all ranks; 0: does not
};

class SharedResumeTest : public test::FolderTest {
 protected:
  /// The mesh, unless a rank failed.
  std::optional<io::MeshData> attempt(const Trial& trial, const Attempt& how) {
    std::optional<io::MeshData> out;
    std::atomic<std::uint64_t> visits = 0;
    for_ranks({.ranks = how.ranks, .seed = ++seed_, .max_delay = std::chrono::microseconds(300)},
              [&](Team& team) {
                TeamProcesses processes(team);
                test::MemorySink sink;
                RunHooks hooks{.threads = how.threads, .processes = &processes};
                hooks.store.workdir = folder() / "work";
                hooks.store.resume = true;
                hooks.store.group.age = std::chrono::milliseconds(5);
                hooks.before_visit = [&](Index3) {
                  if (++visits == how.fails_after) throw Error(ErrorKind::kResource, "enough");
                };
                try {
                  const RunReport report = run_into(sink, trial, hooks);
                  if (!team.is_first()) return;
                  resumed_ += report.store.resumed_windows;
                  out = sink.mesh();
                } catch (const Error& error) {
                  EXPECT_EQ(error.kind(), ErrorKind::kResource) << error.what();
                }
              });
    return out;
  }

  [[nodiscard]] bool has_folder() const { return std::filesystem::exists(folder() / "work"); }
  [[nodiscard]] std::uint64_t resumed() const { return resumed_; }

 private:
  std::uint32_t seed_ = 0;
  std::uint64_t resumed_ = 0;
};

TEST_F(SharedResumeTest, Promise7GoesOnFromTheLastEpochWithAnyNumberOfProcesses) {
  std::mt19937 random(411);
  for (std::size_t i = 0; i < 10 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    Trial trial = random_trial(random, random_volume_of(random, kind, {12, 16, 14}, 4));
    trial.settings.window = 4;
    SCOPED_TRACE(trial.text());
    const io::MeshData expected = run_in_memory(trial);
    std::optional<io::MeshData> mesh;
    for (int tries = 0; !mesh; ++tries) {
      mesh = attempt(trial, {.ranks = 1 + static_cast<int>(below(random, 5)),
                             .threads = 1 + static_cast<int>(below(random, 2)),
                             .fails_after = tries < 4 ? 1 + below(random, 250) : 0});
      ASSERT_LT(tries, 5);
    }
    expect_same(*mesh, expected);
    EXPECT_FALSE(has_folder());
  }
  EXPECT_GT(resumed(), 0U);
}

TEST_F(SharedResumeTest, RefusesTheWorkOfOtherSettings) {
  std::mt19937 random(412);
  Trial trial = random_trial(random, random_volume_of(random, VolumeKind::kBlobs, {12, 16, 14}, 4));
  trial.settings.window = 4;
  trial.settings.quality_floor = 0.1;
  ASSERT_FALSE(attempt(trial, {.ranks = 2, .fails_after = 150}).has_value());
  ASSERT_TRUE(std::filesystem::exists(folder() / "work" / "epochs"));
  trial.settings.quality_floor = 0.2;
  for_ranks({.ranks = 2}, [&](Team& team) {
    TeamProcesses processes(team);
    test::MemorySink sink;
    RunHooks hooks{.processes = &processes};
    hooks.store.workdir = folder() / "work";
    hooks.store.resume = true;
    expect_error(ErrorKind::kUsage, {"quality-floor was"},
                 [&] { (void)run_into(sink, trial, hooks); });
  });
}

}  // namespace
}  // namespace mw::engine
