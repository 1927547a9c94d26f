// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parcels: a block's slot, the window that left it, its decoded size, and its bytes.
#include "engine/team/blocks/block_traffic.h"

#include <utility>

#include "engine/team/blocks/partition.h"

namespace mw::engine {
namespace {

Arrivals::Window window_of(const RunLayout& layout, const WindowKey& key) {
  return {key.march, layout.order(key.march).rank(key.window)};
}

/// Returns the rank that needs a version next.
int user_of(const BlockRoute& route, const Partition& partition, const BlockVersion& version) {
  const auto next = route.next_user(version);
  return next ? partition.rank_of(*next) : 0;
}

}  // namespace

BlockTraffic::Attached::Attached(BlockTraffic& traffic, RunStore& store) : traffic_(traffic) {
  BlockTraffic* to = &traffic;
  traffic.rooms_ = IncomingRooms::of(store);
  traffic.team_.listen(
      {.parcel =
           [to, &store](const Team::Head& head, std::vector<std::byte> bytes,
                        std::shared_ptr<void> ticket) {
             to->receive(store, head, std::move(bytes), std::move(ticket));
           },
       .room = [rooms = traffic.rooms_](std::uint64_t bytes) { return rooms->take(bytes); },
       .signalled = [to](std::uint64_t number) { to->signalled_ = number; },
       .sent = [to] { to->arrivals_.wake(); },
       .failed = [to](const Error& error) { to->end(std::make_exception_ptr(error)); }});
}

BlockTraffic::Attached::~Attached() {
  traffic_.team_.listen({});
  traffic_.rooms_->close();
  traffic_.team_.let_go();
}

BlockVersion BlockTraffic::version_of(const Team::Head& head) const {
  const BlockKey block = layout_.key(head[0]);
  return {block, {block.march, layout_.order(block.march).window(head[1])}};
}

void BlockTraffic::receive(RunStore& store, const Team::Head& head, std::vector<std::byte> bytes,
                           std::shared_ptr<void> ticket) {
  const BlockVersion version = version_of(head);
  try {
    store.receive(version, std::move(bytes), head[2], rooms_->claim(ticket));
  } catch (const std::exception&) {
    // There is no room: the march ends with this error if it still runs, else the output does.
    return end(std::current_exception());
  }
  ticket.reset();  // a thread that finds no room now must not wait for this one
  note(version);
  ++received_;
  arrivals_.wake();
}

void BlockTraffic::end(std::exception_ptr error) {
  team_.fail(error);
  arrivals_.fail(std::move(error));
  const std::lock_guard lock(mutex_);  // so that a thread about to wait does not miss this
  changed_.notify_all();
}

void BlockTraffic::note(const BlockVersion& version) {
  if (const auto next = route_.next_user(version)) return arrivals_.add(window_of(layout_, *next));
  {
    const std::lock_guard lock(mutex_);
    ++final_blocks_;
  }
  changed_.notify_all();
}

int BlockTraffic::next_rank(const BlockVersion& version) const {
  return user_of(route_, partition_, version);
}

bool BlockTraffic::stays(const BlockVersion& version) const {
  return next_rank(version) == team_.rank();
}

void BlockTraffic::send(const BlockVersion& version, BlockPin block) {
  bytes_sent_ += block->bytes.size();
  const Team::Head head{layout_.slot(version.block),
                        layout_.order(version.block.march).rank(version.from.window),
                        block->memory_bytes};
  const std::vector<std::byte>* bytes = &block->bytes;
  const int to = next_rank(version);
  {
    const std::lock_guard lock(mutex_);
    ++sent_to_[static_cast<std::size_t>(to)];
  }
  team_.send(to, head, SharedBytes(std::move(block), bytes));
}

void BlockTraffic::committed(std::span<const BlockVersion> versions) {
  for (const BlockVersion& version : versions) note(version);
}

TrafficFacts BlockTraffic::facts() const {
  TrafficFacts out{.blocks = 0, .bytes = bytes_sent_};
  for (std::uint64_t blocks : sent_to()) out.blocks += blocks;
  return out;
}

std::vector<std::uint64_t> BlockTraffic::sent_to() const {
  const std::lock_guard lock(mutex_);
  return sent_to_;
}

void BlockTraffic::wait_for_output() {
  const std::int64_t blocks = layout_.grid(layout_.marches() - 1).blocks().product();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return final_blocks_ == blocks || arrivals_.error() != nullptr; });
  if (const auto error = arrivals_.error()) std::rethrow_exception(error);
}

std::vector<std::uint64_t> blocks_sent(const RunLayout& layout, const Partition& partition,
                                       int ranks) {
  const BlockRoute route(layout);
  std::vector<std::uint64_t> out(static_cast<std::size_t>(ranks));
  for (std::uint32_t march = 0; march < layout.marches(); ++march) {
    const WindowGrid& grid = layout.grid(march);
    for_each_index(grid.windows(), [&](Index3 window) {
      const WindowKey key{march, window};
      const int from = partition.rank_of(key);
      for (Index3 block : grid.blocks_of(window)) {
        if (user_of(route, partition, {{march, block}, key}) != from) {
          ++out[static_cast<std::size_t>(from)];
        }
      }
    });
  }
  return out;
}

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
