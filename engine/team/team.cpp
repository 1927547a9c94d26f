// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/team.h"

#include <utility>

#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

enum Kind : std::uint64_t { kGathered = 1, kParcel, kSignal, kFailure };

std::vector<std::byte> text_bytes(const std::string& text) {
  return bytes_of(text.data(), text.size());
}

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

SharedBytes shared(std::vector<std::byte> bytes) {
  return std::make_shared<const std::vector<std::byte>>(std::move(bytes));
}

}  // namespace

Team::Team(Exchange& exchange) : exchange_(exchange) {
  exchange_.listen(
      {.receive = [this](Message message) { receive(std::move(message)); },
       .room = [this](std::uint64_t kind, std::uint64_t bytes) { return take_room(kind, bytes); },
       .sent =
           [this] {
             const std::lock_guard lock(listening_);
             if (listener_.sent) listener_.sent();
           }});
}

Team::~Team() {
  exchange_.listen({});
}

Team::Gathering Team::next_gathering(Channel channel) {
  const std::lock_guard lock(mutex_);
  return {channel, gatherings_[channel]++};
}

void Team::say(int to, const Gathering& gathering, SharedBytes bytes) {
  exchange_.send(to, {kGathered, static_cast<std::uint64_t>(gathering.first), gathering.second, 0},
                 std::move(bytes));
}

std::vector<std::vector<std::byte>> Team::hear(const Gathering& gathering) {
  std::unique_lock lock(mutex_);
  const auto others = static_cast<std::size_t>(ranks() - 1);
  const auto& said = said_[gathering];
  changed_.wait(lock, [&] { return failure_ || own_failure_ || said.size() == others; });
  if (said.size() < others) throw failure_ ? *failure_ : *own_failure_;
  std::vector<std::vector<std::byte>> out(static_cast<std::size_t>(ranks()));
  for (auto& [from, bytes_said] : said_[gathering]) {
    out[static_cast<std::size_t>(from)] = std::move(bytes_said);
  }
  said_.erase(gathering);
  return out;
}

std::vector<std::vector<std::byte>> Team::gather(std::vector<std::byte> mine, Channel channel) {
  const Gathering gathering = next_gathering(channel);
  const SharedBytes bytes = shared(std::move(mine));
  for (int to = 0; to < ranks(); ++to) {
    if (to != rank()) say(to, gathering, bytes);
  }
  auto out = hear(gathering);
  out[static_cast<std::size_t>(rank())] = *bytes;
  return out;
}

std::vector<std::string> Team::gather(const std::string& mine) {
  std::vector<std::string> out;
  for (const auto& said : gather(text_bytes(mine))) out.push_back(text_of(said));
  return out;
}

void Team::send(int to, const Head& head, SharedBytes bytes) {
  exchange_.send(to, {kParcel, head[0], head[1], head[2]}, std::move(bytes));
}

void Team::signal(std::uint64_t number) {
  for (int to = 0; to < ranks(); ++to) {
    if (to != rank()) exchange_.send(to, {kSignal, number, 0, 0}, nullptr);
  }
}

void Team::listen(Listener listener) {
  const std::lock_guard turn(listening_);
  listener_ = std::move(listener);
  if (!listener_.parcel) return;
  std::vector<Message> waiting;
  std::optional<Error> failure;
  {
    const std::lock_guard lock(mutex_);
    waiting.swap(waiting_);
    failure = failure_;
  }
  for (Message& m : waiting) {
    if (m.head[0] == kSignal) {
      if (listener_.signalled) listener_.signalled(m.head[1]);
      continue;
    }
    listener_.parcel({m.head[1], m.head[2], m.head[3]}, std::move(m.bytes), std::move(m.room));
  }
  if (failure) listener_.failed(*failure);
}

void Team::fail(const Error& error) {
  {
    const std::lock_guard lock(mutex_);
    if (failure_ || own_failure_) return;
    own_failure_ = error;
  }
  changed_.notify_all();
  const std::string who = is_first() ? "" : "rank " + std::to_string(rank()) + ": ";
  const SharedBytes text = shared(text_bytes(who + error.what()));
  const auto kind = static_cast<std::uint64_t>(error.kind());
  for (int to = 0; to < ranks(); ++to) {
    if (to != rank()) exchange_.send(to, {kFailure, kind, 0, 0}, text);
  }
}

void Team::fail(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Error& e) {
    fail(e);
  } catch (const std::exception& e) {
    fail(Error(ErrorKind::kInternal, e.what()));
  } catch (...) {
    fail(Error(ErrorKind::kInternal, "it was stopped"));
  }
}

std::optional<Error> Team::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

bool Team::has_failed() const {
  const std::lock_guard lock(mutex_);
  return failure_.has_value() || own_failure_.has_value();
}

void Team::note_failure(const Error& error) {
  {
    const std::lock_guard lock(mutex_);
    if (failure_) return;
    failure_ = error;
  }
  changed_.notify_all();
  if (listener_.failed) listener_.failed(error);
}

std::shared_ptr<void> Team::take_room(std::uint64_t kind, std::uint64_t bytes) {
  if (kind != kParcel) return nullptr;  // the caller of gather() has room for what it gathers
  const std::lock_guard turn(listening_);
  return listener_.room ? listener_.room(bytes) : nullptr;
}

void Team::receive(Message message) {
  const std::lock_guard turn(listening_);
  switch (message.head[0]) {
    case kGathered: {
      {
        const std::lock_guard lock(mutex_);
        said_[{static_cast<Channel>(message.head[1]), message.head[2]}].emplace(
            message.from, std::move(message.bytes));
      }
      changed_.notify_all();
      return;
    }
    case kParcel:
      if (listener_.parcel) {
        return listener_.parcel({message.head[1], message.head[2], message.head[3]},
                                std::move(message.bytes), std::move(message.room));
      }
      waiting_.push_back(std::move(message));
      return;
    case kSignal:
      if (listener_.signalled) return listener_.signalled(message.head[1]);
      waiting_.push_back(std::move(message));
      return;
    default:
      note_failure(Error(static_cast<ErrorKind>(message.head[1]), text_of(message.bytes)));
  }
}

}  // namespace mw::engine
