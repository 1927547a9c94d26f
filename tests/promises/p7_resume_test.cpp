// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 5 across kills: a run that was killed at any instant goes on to the same mesh.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "tests/engine/memory_run.h"
#include "tests/engine/store/work_folder.h"

namespace mw::engine {
namespace {

using audit::test::random_volume_of;
using audit::test::VolumeKind;
using test::run_in_memory;
using test::Trial;
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
  const test::MemoryVolume volume(trial.volume, trial.frame);
  const io::LabelTable table = io::collect_labels(volume);
  test::MemorySink sink;
  const RunReport report =
      mesh_volume(io::DenseVolume(volume, table), trial.settings, sink, hooks_with(store));
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
    const std::size_t at = message.find("--memory ");
    EXPECT_NE(at, std::string::npos) << message;
    return at == std::string::npos ? 0 : std::stoull(message.substr(at + 9)) << 20;
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

}  // namespace
}  // namespace mw::engine
