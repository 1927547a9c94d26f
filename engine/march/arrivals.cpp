// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/march/arrivals.h"

#include <utility>

namespace mw::engine {

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
