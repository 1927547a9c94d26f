// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Takes workers from a stack and puts them back.
#include "engine/codt/worker_pool.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <thread>
#include <utility>

#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::engine::codt {
namespace {

/// Waits twice as long as after the loss before; after seven losses that makes two seconds.
void pause_after(int losses) {
  constexpr std::chrono::milliseconds kFirst{16};
  std::this_thread::sleep_for(kFirst * (1 << (losses - 1)));
}

[[noreturn]] void fail_lost(const std::filesystem::path& program, int times,
                            const std::string& loss) {
  throw Error(ErrorKind::kResource,
              io::text("--optimizer tetgen: ", times, " workers in a row were lost over a window; ",
                       program.string(), " ", loss,
                       ": see that there is memory for it, give fewer --threads, or mesh with "
                       "another --optimizer"));
}

}  // namespace

WorkerPool::WorkerPool(PoolOptions options) : options_(std::move(options)) {
  if (options_.program.empty()) options_.program = find_worker();
  give_back(take());
}

std::optional<Triangulation> WorkerPool::triangulate(const Plc& plc) {
  using Outcome = WorkerProcess::Outcome;
  constexpr int kMostCrashes = 2, kMostLosses = 8;
  ++requests_;
  Triangulation made;
  std::unique_ptr<WorkerProcess> worker = take();
  for (int crashes = 0, losses = 0;;) {
    const Outcome outcome = worker->run(plc, made, options_.patience);
    if (outcome == Outcome::kAnswered || outcome == Outcome::kRefused) {
      give_back(std::move(worker));
      if (outcome == Outcome::kAnswered) return made;
      ++refused_;
      return std::nullopt;
    }
    ++(outcome == Outcome::kCrashed ? crashes : losses);
    if (crashes == kMostCrashes) {
      ++failed_;
      return std::nullopt;
    }
    if (losses == kMostLosses) fail_lost(options_.program, losses, worker->loss());
    // What takes workers, as a lack of memory does, may pass.
    if (outcome == Outcome::kLost) pause_after(losses);
    ++restarted_;
    worker = std::make_unique<WorkerProcess>(options_.program);
  }
}

PoolFacts WorkerPool::facts() const {
  return {requests_, refused_, failed_, restarted_};
}

std::vector<pid_t> WorkerPool::idle() const {
  const std::lock_guard lock(mutex_);
  std::vector<pid_t> out;
  for (const auto& worker : idle_) out.push_back(worker->id());
  return out;
}

std::unique_ptr<WorkerProcess> WorkerPool::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<WorkerProcess> worker = std::move(idle_.back());
      idle_.pop_back();
      return worker;
    }
  }
  return std::make_unique<WorkerProcess>(options_.program);
}

void WorkerPool::give_back(std::unique_ptr<WorkerProcess> worker) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(worker));
}

}  // namespace mw::engine::codt
