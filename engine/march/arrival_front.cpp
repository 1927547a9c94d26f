// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A range of a process's own windows that advances with the first unfinished one.
#include "engine/march/arrival_front.h"

#include <algorithm>
#include <utility>

#include "kernels/core/assert.h"

namespace mw::engine {

ArrivalFront::ArrivalFront(const WindowOrder& order, const PartialMarch& part,
                           std::uint64_t look_ahead, const IsFinished& finished_before)
    : order_(order), part_(part), look_ahead_(look_ahead) {
  for (std::uint64_t rank = 0; rank < order.size(); ++rank) {
    const Index3 window = order.window(rank);
    if (!part.is_mine(window)) continue;
    mine_.push_back(rank);
    const bool done = finished_before && finished_before(window);
    states_.push_back(done ? State::kFinished : State::kWaiting);
  }
  advance();
}

std::optional<std::uint64_t> ArrivalFront::best() const {
  if (ready_.empty()) return std::nullopt;
  return ready_.begin()->second;
}

std::uint64_t ArrivalFront::first_unfinished() const {
  return first_ < mine_.size() ? mine_[first_] : order_.size();
}

bool ArrivalFront::is_ready(std::uint64_t rank) const {
  return rank < order_.size() && ready_.count(priority(rank)) > 0;
}

void ArrivalFront::start(std::uint64_t rank) {
  MW_ASSERT(is_ready(rank));
  ready_.erase(priority(rank));
  states_[find(rank).value()] = State::kRunning;
  part_.arrivals->forget({part_.march, rank});
}

void ArrivalFront::finish(std::uint64_t rank) {
  const std::size_t at = find(rank).value();
  MW_ASSERT(states_[at] == State::kRunning);
  states_[at] = State::kFinished;
  poll();
  advance();
}

void ArrivalFront::poll() {
  for (std::uint64_t rank : part_.arrivals->take_touched(part_.march)) {
    if (const auto at = find(rank); at && *at < seen_) make_ready_if_due(*at);
  }
}

ArrivalFront::Priority ArrivalFront::priority(std::uint64_t rank) const {
  return {order_.step(order_.window(rank)), rank};
}

std::optional<std::size_t> ArrivalFront::find(std::uint64_t rank) const {
  const auto at = std::lower_bound(mine_.begin(), mine_.end(), rank);
  if (at == mine_.end() || *at != rank) return std::nullopt;
  return static_cast<std::size_t>(at - mine_.begin());
}

void ArrivalFront::make_ready_if_due(std::size_t at) {
  if (states_[at] != State::kWaiting) return;
  const std::uint64_t rank = mine_[at];
  const std::uint32_t there = part_.arrivals->count({part_.march, rank});
  if (there < part_.inputs(order_.window(rank))) return;
  states_[at] = State::kReady;
  ready_.insert(priority(rank));
}

void ArrivalFront::advance() {
  while (first_ < mine_.size() && states_[first_] == State::kFinished) ++first_;
  const std::size_t end = std::min<std::size_t>(first_ + look_ahead_, mine_.size());
  for (; seen_ < end; ++seen_) make_ready_if_due(seen_);
}

void Arrivals::add(Window window) {
  const std::lock_guard lock(mutex_);
  ++counts_[window];
  touched_[window.first].push_back(window.second);
}

std::uint32_t Arrivals::count(Window window) const {
  const std::lock_guard lock(mutex_);
  const auto found = counts_.find(window);
  return found == counts_.end() ? 0 : found->second;
}

void Arrivals::forget(Window window) {
  const std::lock_guard lock(mutex_);
  counts_.erase(window);
}

std::vector<std::uint64_t> Arrivals::take_touched(std::uint32_t march) {
  const std::lock_guard lock(mutex_);
  return std::exchange(touched_[march], {});
}

void Arrivals::wake() {
  const std::lock_guard lock(waking_);
  if (wake_) wake_();
}

void Arrivals::fail(std::exception_ptr error) {
  {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
  }
  wake();
}

std::exception_ptr Arrivals::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

void Arrivals::on_wake(std::function<void()> wake) {
  const std::lock_guard lock(waking_);
  wake_ = std::move(wake);
}

}  // namespace mw::engine
