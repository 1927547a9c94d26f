// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The loop over oneTBB: every index once, and kernels give the same bytes through it.
#include "engine/system/tbb_for.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>

#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

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
      engine::tbb_for(n, [&](std::size_t first, std::size_t last) {
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
    engine::tbb_for_each_index(GetParam(), shape, [&](Index3 i) {
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
    EXPECT_NO_THROW(
        engine::tbb_for_each_index(GetParam(), shape, [&](Index3 /*at*/) { meeting.join(); }));
  }
}

TEST_P(TbbFor, PassesOnWhatAVisitThrows) {
  const auto fail = [](Index3 i) {
    if (i == Index3{1, 2, 3}) throw std::runtime_error("in the middle");
  };
  EXPECT_THROW(engine::tbb_for_each_index(GetParam(), {4, 4, 4}, fail), std::runtime_error);
}

TEST_P(TbbFor, PassesOnWhatABodyThrows) {
  const auto fail = [](std::size_t, std::size_t last) {
    if (last == 100'000) throw std::runtime_error("at the end");
  };
  arena_.execute([&] { EXPECT_THROW(engine::tbb_for(100'000, fail), std::runtime_error); });
}

TEST_P(TbbFor, Promise5SeedsTheQueueOfSimplifyAlike) {
  std::mt19937 random(801);
  const SmallVolume volume = random_volume_of(random, VolumeKind{}, {20, 20, 20}, 4);
  const TetMesh start = dense_mesh(volume);
  ASSERT_GT(start.vertex_count(), 8000U);
  TetMesh mesh = start, threaded = start;
  simplify(mesh, Metric(), {});
  arena_.execute([&] { simplify(threaded, Metric(), {.seeding = engine::tbb_for}); });
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_EQ(threaded.vertex(v), mesh.vertex(v));
    ASSERT_TRUE(std::ranges::equal(threaded.star(v), mesh.star(v)));
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, TbbFor, ::testing::Values(1, 2, 3, 8));

}  // namespace
}  // namespace mw::test
