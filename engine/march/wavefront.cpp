// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A ring of the states of windows, from the sequence's first unfinished one on.
#include "engine/march/wavefront.h"

#include <algorithm>

#include "kernels/core/assert.h"

namespace mw::engine {

Wavefront::Wavefront(const WindowOrder& order, std::uint64_t look_ahead, IsFinished finished_before)
    : order_(order),
      finished_before_(std::move(finished_before)),
      states_(static_cast<std::size_t>(std::min(look_ahead, order.size()))) {
  MW_ASSERT(!states_.empty());
  advance();
}

std::optional<std::uint64_t> Wavefront::best() const {
  if (ready_.empty()) return std::nullopt;
  return ready_.begin()->second;
}

bool Wavefront::is_ready(std::uint64_t rank) const {
  return ready_.count(priority(rank)) > 0;
}

void Wavefront::start(std::uint64_t rank) {
  MW_ASSERT(is_ready(rank));
  ready_.erase(priority(rank));
  state(rank) = State::kRunning;
}

void Wavefront::finish(std::uint64_t rank) {
  MW_ASSERT(state(rank) == State::kRunning);
  state(rank) = State::kFinished;
  for (Index3 s : order_.successors(order_.window(rank))) make_ready_if_due(order_.rank(s));
  advance();
}

bool Wavefront::is_finished(std::uint64_t rank) const {
  if (rank < first_) return true;
  return rank < created_ && states_[rank % states_.size()] == State::kFinished;
}

Wavefront::Priority Wavefront::priority(std::uint64_t rank) const {
  return {order_.step(order_.window(rank)), rank};
}

void Wavefront::make_ready_if_due(std::uint64_t rank) {
  if (rank >= created_ || state(rank) != State::kWaiting) return;
  for (Index3 p : order_.predecessors(order_.window(rank))) {
    if (!is_finished(order_.rank(p))) return;
  }
  state(rank) = State::kReady;
  ready_.insert(priority(rank));
}

/// Forgets windows before the first unfinished one, and creates those that came within reach.
void Wavefront::advance() {
  while (true) {
    while (first_ < created_ && is_finished(first_)) ++first_;
    if (created_ == order_.size() || created_ - first_ == states_.size()) return;
    const std::uint64_t rank = created_++;
    const bool done = finished_before_ && finished_before_(order_.window(rank));
    state(rank) = done ? State::kFinished : State::kWaiting;
    make_ready_if_due(rank);
  }
}

}  // namespace mw::engine
