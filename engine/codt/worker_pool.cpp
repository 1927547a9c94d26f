// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Takes workers from a stack and puts them back.
#include "engine/codt/worker_pool.h"

namespace mw::engine::codt {

WorkerPool::WorkerPool(PoolOptions options) : options_(std::move(options)) {
  if (options_.program.empty()) options_.program = find_worker();
  give_back(take());
}

std::optional<Triangulation> WorkerPool::triangulate(const Plc& plc) {
  ++requests_;
  Triangulation made;
  std::unique_ptr<WorkerProcess> worker = take();
  WorkerProcess::Outcome outcome = worker->run(plc, made, options_.patience);
  if (outcome == WorkerProcess::Outcome::kDead) {
    ++restarted_;
    worker = std::make_unique<WorkerProcess>(options_.program);
    outcome = worker->run(plc, made, options_.patience);
  }
  if (outcome == WorkerProcess::Outcome::kDead) {
    ++failed_;
    return std::nullopt;
  }
  give_back(std::move(worker));
  if (outcome == WorkerProcess::Outcome::kAnswered) return made;
  ++refused_;
  return std::nullopt;
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
