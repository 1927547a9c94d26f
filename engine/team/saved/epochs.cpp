// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/saved/epochs.h"

#include <utility>

#include "engine/run/processes.h"
#include "engine/team/team.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kEnd = ~std::uint64_t{0};  ///< signals that no more epochs follow
constexpr std::chrono::milliseconds kLook{1};

}  // namespace

Epochs::Epochs(Team& team, BlockTraffic& traffic, RunStore& store, Options options)
    : team_(team), traffic_(traffic), store_(store), options_(std::move(options)) {}

Epochs::~Epochs() {
  if (thread_.joinable()) thread_.join();
}

void Epochs::start() {
  thread_ = std::thread([this] {
    try {
      if (team_.is_first()) {
        lead();
      } else {
        follow();
      }
    } catch (...) {
      // If a failure is known already, this thread has ended because of it.
      if (!team_.has_failed()) traffic_.end(std::current_exception());
    }
  });
}

void Epochs::end() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
}

/// Polls, because what it waits for may come about in many ways, and epochs are rare.
void Epochs::sleep_until(const std::function<bool()>& over) const {
  while (!over()) {
    if (team_.has_failed()) {
      throw team_.failure().value_or(Error(ErrorKind::kInternal, "this process has failed"));
    }
    std::this_thread::sleep_for(kLook);
  }
}

void Epochs::lead() {
  while (!ending_) {
    const auto due = std::chrono::steady_clock::now() + options_.every;
    const auto stops = [&] { return options_.stop && options_.stop(); };
    sleep_until([&] { return ending_ || stops() || std::chrono::steady_clock::now() >= due; });
    if (ending_) break;
    team_.signal(epochs_ + 1);
    run_one();
    if (stops()) throw StoppedAfterSave{};
  }
  team_.signal(kEnd);
}

void Epochs::follow() {
  for (;;) {
    sleep_until([&] { return traffic_.signalled() > epochs_; });
    if (traffic_.signalled() == kEnd) return;
    run_one();
  }
}

void Epochs::run_one() {
  store_.pause();
  sleep_until([&] { return store_.is_quiet(); });
  // No rank sends more blocks; this one waits for those that were sent to it.
  std::uint64_t wanted = 0;
  const std::vector<std::uint64_t> sent = traffic_.sent_to();
  const auto me = static_cast<std::size_t>(team_.rank());
  for (const auto& said :
       team_.gather(bytes_of(sent.data(), sent.size()), Team::Channel::kEpochs)) {
    wanted += list_of<std::uint64_t>(said).at(me);
  }
  sleep_until([&] { return traffic_.received() == wanted; });
  store_.checkpoint();
  (void)team_.gather({}, Team::Channel::kEpochs);
  ++epochs_;
  if (team_.is_first()) options_.count(epochs_);
  (void)team_.gather({}, Team::Channel::kEpochs);
  store_.go_on();
  traffic_.arrivals().wake();
}

}  // namespace mw::engine
