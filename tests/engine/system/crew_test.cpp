// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A crew's helpers take part in what is run, also after a pause; loops visit every index once, and
// kernels give the same bytes through them.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sched.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "engine/system/control_groups.h"
#include "engine/system/crew.h"
#include "engine/system/memory.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"
#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::engine {
namespace {

using namespace std::chrono_literals;

/// Whether as many threads are in as many tasks at the same time.
bool all_meet(Crew& crew) {
  const int size = crew.size();
  const auto deadline = std::chrono::steady_clock::now() + 60s;
  std::atomic<int> inside = 0;
  std::atomic<bool> late = false;
  std::vector<std::atomic<int>> slots(static_cast<std::size_t>(size));
  crew.run([&] {
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<int>(0, size, 1),
        [&](const auto&) {
          ++slots.at(
              static_cast<std::size_t>(oneapi::tbb::this_task_arena::current_thread_index()));
          ++inside;
          while (inside < size && !late) {
            late = std::chrono::steady_clock::now() > deadline;
            std::this_thread::yield();
          }
        },
        oneapi::tbb::simple_partitioner());
  });
  for (const auto& times : slots) EXPECT_EQ(times, 1);
  return !late;
}

TEST(Crew, NoThreadsMeansTheCoresThatThisProcessMayUse) {
  EXPECT_EQ(thread_count(5), 5);
  cpu_set_t all;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  EXPECT_GE(thread_count(0), 1);
  EXPECT_LE(thread_count(0), CPU_COUNT(&all));
}

/// oneTBB looks at the mask of a process once, so another process is asked, which begins with one
/// core.
TEST(Crew, AProcessBoundToOneCoreTakesOneThread) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  cpu_set_t all, one;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (std::size_t core = 0; CPU_COUNT(&one) == 0; ++core) {
    if (CPU_ISSET(core, &all)) CPU_SET(core, &one);
  }
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EXIT(std::exit(thread_count(0)), ::testing::ExitedWithCode(1), "");
  ASSERT_EQ(::sched_setaffinity(0, sizeof all, &all), 0);
}

TEST(Crew, IsAsManyThreadsAsWereAskedFor) {
  for (const int threads : {1, 2, 3, 8}) {
    Crew crew(threads);
    ASSERT_EQ(crew.size(), threads);
    EXPECT_TRUE(all_meet(crew)) << threads;
    std::this_thread::sleep_for(50ms);  // by then the helpers sleep
    EXPECT_TRUE(all_meet(crew)) << threads << ", after a pause";
  }
}

TEST(Crew, ComesAndGoesWithoutWork) {
  for (int i = 0; i < 200; ++i) EXPECT_EQ(Crew(1 + i % 5).size(), 1 + i % 5);
}

TEST(Crew, PassesOnWhatTheWorkThrows) {
  Crew crew(3);
  EXPECT_THROW(crew.run([] { throw std::runtime_error("at work"); }), std::runtime_error);
  const auto fail = [](int i) {
    if (i == 77) throw std::runtime_error("in a task");
  };
  EXPECT_THROW(crew.run([&] { oneapi::tbb::parallel_for(0, 1000, fail); }), std::runtime_error);
  EXPECT_TRUE(all_meet(crew));
}

TEST(Crew, TwoOfThemDoNotMindEachOther) {
  Crew outer(3);
  Crew inner(2);
  outer.run([&] { EXPECT_TRUE(all_meet(inner)); });
  EXPECT_TRUE(all_meet(outer));
}

// The budget when none is given.

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

TEST(MachineMemory, TakesTheLeastLimitOfNestedGroups) {
  const test::TempFolder folder;
  const auto limit = [&](const std::string& group, const std::string& text) {
    std::filesystem::create_directories(folder.path() / group);
    std::ofstream(folder.path() / group / "memory.max") << text;
  };
  const auto found = [&](const std::string& groups) {
    std::istringstream in(groups);
    return cgroup_limit(folder.path(), in);
  };
  EXPECT_EQ(found("0::/user/job\n"), kNone);
  limit("user", "5000\n");
  limit("user/job", "max\n");
  EXPECT_EQ(found("0::/user/job\n"), 5000U);
  limit("user/job", "3000\n");
  EXPECT_EQ(found("1:name=systemd:/x\n0::/user/job\n"), 3000U);
  EXPECT_EQ(found("0::/user\n"), 5000U);
  EXPECT_EQ(found("0::/\n"), kNone);
  std::filesystem::create_directories(folder.path() / "memory" / "a");
  std::ofstream(folder.path() / "memory" / "a" / "memory.limit_in_bytes") << "2000\n";
  EXPECT_EQ(found("4:memory:/a/b\n0::/user\n"), 2000U);
}

TEST(MachineCores, AreTheLeastOfNestedGroups) {
  const test::TempFolder folder;
  const auto put = [&](const std::string& group, const std::string& file, const std::string& text) {
    std::filesystem::create_directories(folder.path() / group);
    std::ofstream(folder.path() / group / file) << text;
  };
  const auto found = [&](const std::string& groups) {
    std::istringstream in(groups);
    return cgroup_cores(folder.path(), in);
  };
  EXPECT_EQ(found("0::/user/job\n"), std::nullopt);
  put("user", "cpu.max", "400000 100000\n");
  put("user/job", "cpu.max", "max 100000\n");
  EXPECT_EQ(found("0::/user/job\n"), 4);
  put("user/job", "cpu.max", "150000 100000\n");
  EXPECT_EQ(found("1:name=systemd:/x\n0::/user/job\n"), 2);
  EXPECT_EQ(found("0::/user\n"), 4);
  put("user/job/small", "cpu.max", "1000 100000\n");
  EXPECT_EQ(found("0::/user/job/small\n"), 1);
  put("cpu/a", "cpu.cfs_quota_us", "300000\n");
  put("cpu/a", "cpu.cfs_period_us", "100000\n");
  put("cpu/b", "cpu.cfs_quota_us", "-1\n");
  put("cpu/b", "cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(found("4:cpu,cpuacct:/a/b\n"), 3);
  EXPECT_EQ(found("4:cpuacct,cpu:/a\n"), 3);
  EXPECT_EQ(found("4:cpuset:/a\n"), std::nullopt);
  EXPECT_EQ(found("4:cpu:/b\n"), std::nullopt);
}

TEST(MachineMemory, IsAtMostHalfOfTheMachine) {
  std::ifstream meminfo("/proc/meminfo");
  std::string name;
  std::uint64_t kib = 0;
  meminfo >> name >> kib;
  ASSERT_EQ(name, "MemTotal:");
  EXPECT_LE(default_memory_budget(), kib * 512);
  EXPECT_GT(default_memory_budget(), 0U);
}

// Amounts in files of /proc.

TEST(ProcFile, TellsTheAmountOfALine) {
  const std::string text =
      "MemTotal: 9000 kB\nMemFree: 10 kB\nMemFreeMore: 5 kB\nLast:    700 kB\n";
  const auto bytes = [&](std::string_view name) {
    std::istringstream file(text);
    return proc_bytes(file, name);
  };
  EXPECT_EQ(bytes("MemTotal"), 9000U * 1024);
  EXPECT_EQ(bytes("MemFreeMore"), 5U * 1024);
  EXPECT_EQ(bytes("Last"), 700U * 1024);
  EXPECT_EQ(bytes("Mem"), std::nullopt);
  EXPECT_EQ(bytes("MemAvailable"), std::nullopt);
}

/// Lets TBB have more threads than the machine has cores.
class TbbFor : public ::testing::TestWithParam<int> {
 protected:
  static constexpr std::size_t kMaxThreads = 8;

  tbb::global_control allow_{tbb::global_control::max_allowed_parallelism, kMaxThreads};
  tbb::task_arena arena_{GetParam()};
};

TEST_P(TbbFor, CoversEveryIndexOnce) {
  for (const std::size_t n : {0U, 1U, 1000U, 4096U, 100'003U}) {
    std::vector<std::atomic<int>> times(n);
    arena_.execute([&] {
      tbb_for(n, [&](std::size_t first, std::size_t last) {
        ASSERT_LT(first, last);
        for (std::size_t i = first; i < last; ++i) ++times[i];
      });
    });
    for (const auto& t : times) ASSERT_EQ(t, 1);
  }
}

TEST_P(TbbFor, CoversEveryIndexOfAnArrayOnce) {
  for (const Index3 shape : {Index3{3, 5, 7}, Index3{1, 1, 40}, Index3{6, 1, 1}, Index3{4, 0, 4}}) {
    std::vector<std::atomic<int>> times(static_cast<std::size_t>(shape.product()));
    tbb_for_each_index(GetParam(), shape, [&](Index3 i) {
      ++times.at(static_cast<std::size_t>((i.z * shape.y + i.y) * shape.x + i.x));
    });
    for (const auto& t : times) ASSERT_EQ(t, 1);
  }
}

/// Two visits that wait for each other, which visits by one thread alone never do.
class Meeting {
 public:
  void join() {
    std::unique_lock lock(mutex_);
    ++come_;
    changed_.notify_all();
    const auto is_met = [this] { return come_ > 1; };
    if (!changed_.wait_for(lock, std::chrono::seconds(20), is_met))
      throw std::runtime_error("alone");
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int come_ = 0;
};

TEST_P(TbbFor, SharesAnArrayOfOneRow) {
  if (GetParam() == 1) return;
  for (const Index3 shape : {Index3{64, 1, 1}, Index3{1, 64, 1}, Index3{1, 1, 64}}) {
    Meeting meeting;
    EXPECT_NO_THROW(tbb_for_each_index(GetParam(), shape, [&](Index3 /*at*/) { meeting.join(); }));
  }
}

TEST_P(TbbFor, PassesOnWhatAVisitThrows) {
  const auto fail = [](Index3 i) {
    if (i == Index3{1, 2, 3}) throw std::runtime_error("in the middle");
  };
  EXPECT_THROW(tbb_for_each_index(GetParam(), {4, 4, 4}, fail), std::runtime_error);
}

TEST_P(TbbFor, PassesOnWhatABodyThrows) {
  const auto fail = [](std::size_t, std::size_t last) {
    if (last == 100'000) throw std::runtime_error("at the end");
  };
  arena_.execute([&] { EXPECT_THROW(tbb_for(100'000, fail), std::runtime_error); });
}

TEST_P(TbbFor, Promise5SeedsTheQueueOfSimplifyAlike) {
  std::mt19937 random(801);
  const test::SmallVolume volume =
      test::random_volume_of(random, test::VolumeKind{}, {20, 20, 20}, 4);
  const TetMesh start = test::dense_mesh(volume);
  ASSERT_GT(start.vertex_count(), 8000U);
  TetMesh mesh = start, threaded = start;
  simplify(mesh, Metric(), {});
  arena_.execute([&] { simplify(threaded, Metric(), {.seeding = tbb_for}); });
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_EQ(threaded.vertex(v), mesh.vertex(v));
    ASSERT_TRUE(std::ranges::equal(threaded.star(v), mesh.star(v)));
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, TbbFor, ::testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace mw::engine
