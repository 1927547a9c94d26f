// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Helpers wait in the arena for a task that does not come until they end, and work meanwhile.
// Loops make tasks of ranges of a given size, and of parts of an array.
#include "engine/system/crew.h"

#include <oneapi/tbb/task_group.h>
#include <pthread.h>
#include <tbb/blocked_range.h>
#include <tbb/blocked_range3d.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <fstream>

#include "engine/system/control_groups.h"
#include "io/remote/wait_stop.h"

namespace mw::engine {
namespace {

/// The stack that oneTBB gives its own threads, whatever `ulimit -s` says.
constexpr std::size_t kStackBytes = std::size_t{4} << 20U;

constexpr std::size_t kRangesAThread = 4;
constexpr std::size_t kShortestRange = 1024;

}  // namespace

int thread_count(int threads) {
  if (threads > 0) return threads;
  std::ifstream groups("/proc/self/cgroup");
  const int own = tbb::info::default_concurrency();  // as many as the affinity mask has
  return std::max(1, std::min(own, cgroup_cores("/sys/fs/cgroup", groups).value_or(own)));
}

/// A thread that takes part in the arena's work until this is destroyed.  Its waits for servers end
/// as those of the thread that made it, which outlives it.
class Crew::Helper {
 public:
  explicit Helper(oneapi::tbb::task_arena& arena) : arena_(arena), leave_(group_.defer([] {})) {}
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  ~Helper() {
    leave_ = {};
    if (started_) ::pthread_join(thread_, nullptr);
  }

  /// Returns true if the system gave a thread.
  [[nodiscard]] bool start() {
    pthread_attr_t attributes;
    if (::pthread_attr_init(&attributes) != 0) return false;
    started_ = ::pthread_attr_setstacksize(&attributes, kStackBytes) == 0 &&
               ::pthread_create(&thread_, &attributes, &Helper::help, this) == 0;
    ::pthread_attr_destroy(&attributes);
    return started_;
  }

 private:
  static void* help(void* self) {
    auto& helper = *static_cast<Helper*>(self);
    const io::WaitStop alike(helper.stop_);
    try {
      helper.arena_.execute([&] { helper.group_.wait(); });
    } catch (...) {
      // There is no memory to take part: the other threads do the work.
    }
    return nullptr;
  }

  oneapi::tbb::task_arena& arena_;
  const io::WaitStop::Stop* stop_ = io::WaitStop::current();
  oneapi::tbb::task_group group_;
  oneapi::tbb::task_handle leave_;  ///< while it is there, the group has a task to wait for
  pthread_t thread_{};
  bool started_ = false;
};

// All slots are reserved for threads that enter the arena themselves, so oneTBB fills none.
Crew::Crew(int threads) : arena_(threads, static_cast<unsigned>(threads)) {
  arena_.initialize();
  for (int i = 1; i < threads; ++i) {
    auto helper = std::make_unique<Helper>(arena_);
    if (!helper->start()) return;
    helpers_.push_back(std::move(helper));
  }
}

Crew::~Crew() = default;

void tbb_for(std::size_t n, const RangeBody& body) {
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  // TBB halves ranges that are longer than the grain, so those that it leaves are at least half.
  const std::size_t grain = std::max(2 * kShortestRange, n / (kRangesAThread * threads));
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, grain),
        [&](const tbb::blocked_range<std::size_t>& r) {
          const SharedWork counted;
          body(r.begin(), r.end());
        },
        tbb::simple_partitioner());
  });
}

void tbb_for_each_index(int threads, Index3 shape, const std::function<void(Index3)>& visit) {
  if (threads == 1) {
    const SharedWork counted;
    for_each_index(shape, visit);
    return;
  }
  using Part = tbb::blocked_range3d<std::int64_t>;
  Crew(threads).run([&] {
    tbb::parallel_for(Part(0, shape.z, 0, shape.y, 0, shape.x), [&](const Part& part) {
      const SharedWork counted;
      for_each_index(Box3{{part.cols().begin(), part.rows().begin(), part.pages().begin()},
                          {part.cols().end(), part.rows().end(), part.pages().end()}},
                     visit);
    });
  });
}

}  // namespace mw::engine
