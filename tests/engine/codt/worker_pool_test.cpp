// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Many workers answer as one; dead, hanging and lying ones cost a window its CODT and no more.
#include "engine/codt/worker_pool.h"

#include <signal.h>

#include <condition_variable>
#include <thread>

#include "kernels/core/error.h"
#include "kernels/odt/replacement.h"
#include "tests/engine/codt/random_plcs.h"
#include "tests/expect_error.h"
#include "tests/temp_folder.h"

namespace mw::engine::codt {
namespace {

using namespace test;

#define NEEDS_WORKER() \
  if (!has_worker()) GTEST_SKIP() << "built without TetGen"

/// How many windows; MW_TEST_CODT_WINDOWS asks for more (10,000 take minutes).
std::size_t window_count() {
  const char* const wanted = std::getenv("MW_TEST_CODT_WINDOWS");  // NOLINT(concurrency-mt-unsafe)
  return wanted == nullptr ? 150 : static_cast<std::size_t>(std::atoi(wanted));
}

PoolOptions real_workers() {
  return {.program = MW_CODT_WORKER};
}

/// Asks for all answers with this many threads, in whatever order they come.
std::vector<Answer> answers(WorkerPool& pool, const std::vector<Plc>& plcs, int threads) {
  std::vector<Answer> out(plcs.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> crew;
  for (int i = 0; i < threads; ++i) {
    crew.emplace_back([&] {
      for (std::size_t k = next++; k < plcs.size(); k = next++) out[k] = answer_of(pool, plcs[k]);
    });
  }
  for (std::thread& t : crew) t.join();
  return out;
}

TEST(WorkerPool, ConcurrentAnswersAreTheSequentialOnes) {
  NEEDS_WORKER();
  std::mt19937 random(1301);
  std::vector<Plc> plcs;
  for (std::size_t i = 0; i < window_count(); ++i) plcs.push_back(random_plc(random));
  WorkerPool one(real_workers());
  const std::vector<Answer> reference = answers(one, plcs, 1);
  EXPECT_EQ(one.facts().requests, plcs.size());
  EXPECT_LT(one.facts().refused, plcs.size() / 20 + 1);
  for (int threads : {2, 4, 8}) {
    WorkerPool pool(real_workers());
    EXPECT_TRUE(answers(pool, plcs, threads) == reference) << threads << " threads";
    EXPECT_EQ(pool.facts().restarted, 0U);
    EXPECT_LE(pool.idle().size(), static_cast<std::size_t>(threads));
  }
  // Nor does it matter what a worker was asked before.
  WorkerPool other(real_workers());
  for (std::size_t i = plcs.size(); i-- > 0;) {
    ASSERT_TRUE(answer_of(other, plcs[i]) == reference[i]) << "window " << i;
  }
}

TEST(WorkerPool, KilledWorkersChangeNoAnswer) {
  NEEDS_WORKER();
  std::mt19937 random(1302);
  std::vector<Plc> plcs;
  for (std::size_t i = 0; i < window_count(); ++i) plcs.push_back(random_plc(random));
  WorkerPool calm(real_workers());
  const std::vector<Answer> reference = answers(calm, plcs, 1);
  WorkerPool pool(real_workers());
  std::vector<Answer> out;
  for (const Plc& plc : plcs) {
    for (const pid_t id : pool.idle()) {
      if (below(random, 3) == 0) ::kill(id, below(random, 2) == 0 ? SIGKILL : SIGSEGV);
    }
    out.push_back(answer_of(pool, plc));
  }
  EXPECT_TRUE(out == reference);
  EXPECT_GT(pool.facts().restarted, plcs.size() / 10);
  EXPECT_EQ(pool.facts().failed, 0U);
}

/// Answers of TetGen hold up against the proof on windows of every kind.
TEST(WorkerPool, AnswersReplaceWhatTheyWereAskedFor) {
  NEEDS_WORKER();
  std::mt19937 random(1303);
  WorkerPool pool(real_workers());
  std::uint64_t patches = 0, unproved = 0, points_added = 0;
  for (std::size_t i = 0; i < window_count(); ++i) {
    const TetMesh mesh = test::random_mesh(random);
    const WindowPlc asked = window_plc(mesh, Metric());
    const std::optional<Triangulation> made = pool.triangulate(asked.plc);
    if (!made) continue;
    std::vector<std::optional<Point>> added;
    for (const PlcPoint& p : made->added) added.push_back(asked.frame.to_lattice(p));
    const Replacement out = replace_proved(mesh, Metric(), asked.content, added, *made, 0.0);
    patches += out.stats.patches;
    unproved += out.stats.unproved;
    points_added += added.size();
  }
  RecordProperty("patches", std::to_string(patches));
  RecordProperty("unproved", std::to_string(unproved));
  RecordProperty("refused", std::to_string(pool.facts().refused));
  RecordProperty("points_added", std::to_string(points_added));
  EXPECT_GT(patches, window_count());
  EXPECT_LT(unproved, patches / 10);
}

/// A program of a few lines in place of the worker.
class FakeWorker {
 public:
  explicit FakeWorker(const std::string& script) : program_(folder_.path() / "worker") {
    std::ofstream(program_) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(program_, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] PoolOptions options(int patience_ms = 20'000) const {
    return {.program = program_, .patience = std::chrono::milliseconds(patience_ms)};
  }

 private:
  mw::test::TempFolder folder_;
  std::filesystem::path program_;
};

void expect_failures(WorkerPool& pool) {
  std::mt19937 random(1304);
  constexpr std::uint64_t kRequests = 3;
  for (std::uint64_t i = 0; i < kRequests; ++i) {
    EXPECT_FALSE(pool.triangulate(random_plc(random)));
  }
  EXPECT_EQ(pool.facts().failed, kRequests);
  EXPECT_EQ(pool.facts().restarted, kRequests);
  EXPECT_TRUE(pool.idle().empty());
}

TEST(WorkerPool, GivesUpOnWorkersThatDie) {
  for (const char* signal : {"SEGV", "ABRT", "FPE", "BUS"}) {
    const FakeWorker crash(std::string("kill -") + signal + " $$");
    WorkerPool crashing(crash.options());
    expect_failures(crashing);
  }
}

/// No answer may come of it, as another run might get one.
TEST(WorkerPool, EndsWhereTheMachineTakesEachWorker) {
  struct Case {
    const char* script;
    const char* said;
    int patience_ms;
  };
  std::mt19937 random(1308);
  const Plc plc = random_plc(random);
  for (const Case& c : {Case{"kill -KILL $$", "ended by signal 9 (Killed)", 20'000},
                        Case{"kill -TERM $$", "ended by signal 15 (Terminated)", 20'000},
                        Case{"exit 3", "ended with exit code 3", 20'000},
                        Case{"exec sleep 1000", "took more than 0.02 s", 20},
                        Case{"while :; do :; done", "took more than 0.02 s", 20}}) {
    const FakeWorker worker(c.script);
    WorkerPool pool(worker.options(c.patience_ms));
    expect_error(ErrorKind::kResource, {"8 workers in a row", c.said},
                 [&] { (void)pool.triangulate(plc); });
    EXPECT_EQ(pool.facts().failed, 0U);
    EXPECT_EQ(pool.facts().restarted, 7U);
  }
}

/// A debugger may stop it, or a machine with too much to do.
TEST(WorkerPool, WaitsForAWorkerThatIsStopped) {
  NEEDS_WORKER();
  std::mt19937 random(1309);
  const Plc plc = random_plc(random);
  WorkerPool pool({.program = MW_CODT_WORKER, .patience = std::chrono::milliseconds(1000)});
  const Answer reference = answer_of(pool, plc);
  const pid_t id = pool.idle().at(0);
  ::kill(id, SIGSTOP);
  std::thread waker([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    ::kill(id, SIGCONT);
  });
  EXPECT_TRUE(answer_of(pool, plc) == reference);
  waker.join();
  EXPECT_EQ(pool.facts().restarted, 0U);
}

TEST(WorkerPool, GivesUpOnWorkersThatTalkNonsense) {
  for (const char* say :
       {"echo garbage >&3", "head -c 16 /dev/zero >&3", "cat /dev/zero | head -c 100 >&3"}) {
    const FakeWorker worker(std::string(say) + "; exec sleep 1000");
    WorkerPool pool(worker.options(300));
    expect_failures(pool);
  }
}

/// Says "done, 2^40 bytes" to everything: the engine does not make room for that.
TEST(WorkerPool, GivesUpOnWorkersThatClaimTooMuch) {
  const FakeWorker worker(R"(while :; do printf '\1\0\0\0\0\0\0\0\0\0\0\0\0\1\0\0' >&3; done)");
  WorkerPool pool(worker.options(2000));
  expect_failures(pool);
}

TEST(WorkerPool, RefusesProgramsThatCannotStart) {
  const mw::test::TempFolder folder;
  const auto expect_usage = [&](const std::filesystem::path& program) {
    expect_error(ErrorKind::kUsage, {program.string()},
                 [&] { const WorkerPool pool({.program = program}); });
  };
  expect_usage(folder.path() / "missing");
  std::ofstream(folder.path() / "text") << "no program";
  expect_usage(folder.path() / "text");
}

/// Nothing is left in /dev/shm, whatever became of the workers.
TEST(WorkerPool, LeavesNoSharedMemoryBehind) {
  const auto names = [] {
    std::set<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("mwmesh-" + std::to_string(::getpid()) + "-")) out.insert(name);
    }
    return out;
  };
  std::mt19937 random(1306);
  {
    const FakeWorker crash("kill -SEGV $$");
    WorkerPool pool(has_worker() ? real_workers() : crash.options());
    (void)pool.triangulate(random_plc(random));
    EXPECT_EQ(names(), std::set<std::string>{});
    WorkerPool failing(crash.options());
    (void)failing.triangulate(random_plc(random));
  }
  EXPECT_EQ(names(), std::set<std::string>{});
}

/// A worker ends when the pool goes; here by its own watch, since nobody waits for it.
TEST(WorkerPool, WorkersEndWithTheirPool) {
  NEEDS_WORKER();
  std::mt19937 random(1307);
  std::vector<pid_t> workers;
  {
    WorkerPool pool(real_workers());
    (void)pool.triangulate(random_plc(random));
    workers = pool.idle();
    ASSERT_EQ(workers.size(), 1U);
    EXPECT_EQ(::kill(workers[0], 0), 0);
  }
  EXPECT_EQ(::kill(workers[0], 0), -1);
}

}  // namespace
}  // namespace mw::engine::codt
