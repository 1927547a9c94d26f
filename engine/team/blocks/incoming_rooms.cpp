// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/blocks/incoming_rooms.h"

#include <utility>

namespace mw::engine {

struct IncomingRooms::Ticket {
  Ticket(std::shared_ptr<IncomingRooms> of_rooms, std::uint64_t of_number)
      : rooms(std::move(of_rooms)), number(of_number) {}
  Ticket(const Ticket&) = delete;
  Ticket& operator=(const Ticket&) = delete;
  ~Ticket() { rooms->forget(number); }

  std::shared_ptr<IncomingRooms> rooms;
  std::uint64_t number;
};

std::shared_ptr<void> IncomingRooms::take(std::uint64_t encoded_bytes) {
  const std::lock_guard lock(mutex_);
  if (store_ == nullptr) return nullptr;
  auto room = store_->try_reserve(Purpose::kBlocks, RunStore::cost_of(encoded_bytes));
  if (!room) return nullptr;
  rooms_.emplace(next_, std::move(*room));
  return std::make_shared<Ticket>(shared_from_this(), next_++);
}

MemoryBudget::Reservation IncomingRooms::claim(const std::shared_ptr<void>& ticket) {
  if (ticket == nullptr) return {};
  const std::lock_guard lock(mutex_);
  const auto room = rooms_.find(static_cast<const Ticket*>(ticket.get())->number);
  return room == rooms_.end() ? MemoryBudget::Reservation() : std::move(room->second);
}

bool IncomingRooms::is_empty() const {
  const std::lock_guard lock(mutex_);
  return rooms_.empty();
}

void IncomingRooms::close() {
  const std::lock_guard lock(mutex_);
  store_ = nullptr;
  rooms_.clear();
}

void IncomingRooms::forget(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  rooms_.erase(number);
}

}  // namespace mw::engine
