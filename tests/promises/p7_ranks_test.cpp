// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promise 7 with several processes: a run in which one fails at any window goes on from its last
// epoch, with any number of processes, to the mesh of one process.  Processes are threads here;
// tests/mpi kills real ones.
#include <gtest/gtest.h>

#include <atomic>

#include "engine/run/run.h"
#include "engine/team/team_processes.h"
#include "io/mesh/open_mesh.h"
#include "tests/engine/memory_run.h"
#include "tests/engine/store/work_folder.h"
#include "tests/engine/team/crowd.h"

namespace mw::engine {
namespace {

using audit::test::below;
using audit::test::random_volume_of;
using audit::test::VolumeKind;
using test::expect_same;
using test::for_ranks;
using test::random_trial;
using test::run_in_memory;
using test::Trial;

struct Attempt {
  int ranks = 1;
  int threads = 1;
  std::uint64_t fails_after = 0;  ///< visits of all ranks; 0: does not
  bool together = false;          ///< all ranks write the mesh
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
                const test::MemoryVolume volume(trial.volume, trial.frame);
                test::MemorySink sink;
                const auto shared = io::open_shared_mesh(folder() / "m.vtkhdf");
                if (how.together && team.is_first()) shared->create();
                RunHooks hooks{.threads = how.threads, .processes = &processes};
                if (how.together || !team.is_first()) hooks.together = shared.get();
                hooks.store.workdir = folder() / "work";
                hooks.store.resume = true;
                hooks.store.group.age = std::chrono::milliseconds(5);
                hooks.before_visit = [&](Index3) {
                  if (++visits == how.fails_after) throw Error(ErrorKind::kResource, "enough");
                };
                try {
                  const RunReport report =
                      mesh_volume(io::DenseVolume(volume, io::collect_labels(volume)),
                                  trial.settings, sink, hooks);
                  if (!team.is_first()) return;
                  resumed_ += report.store.resumed_windows;
                  EXPECT_EQ(report.written_together, how.together);
                  out = how.together ? io::read_mesh(folder() / "m.vtkhdf") : sink.mesh();
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
                             .fails_after = tries < 4 ? 1 + below(random, 250) : 0,
                             .together = below(random, 2) == 0});
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
    const test::MemoryVolume volume(trial.volume, trial.frame);
    test::MemorySink sink;
    RunHooks hooks{.processes = &processes};
    hooks.store.workdir = folder() / "work";
    hooks.store.resume = true;
    try {
      (void)mesh_volume(io::DenseVolume(volume, io::collect_labels(volume)), trial.settings, sink,
                        hooks);
      ADD_FAILURE() << "the settings are others";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      EXPECT_NE(std::string(error.what()).find("quality-floor was"), std::string::npos);
    }
  });
}

}  // namespace
}  // namespace mw::engine
