// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Memory that is reserved in the budget for blocks that are about to come in.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "engine/store/run_store.h"

namespace mw::engine {

/// Each message on its way has a ticket, which may outlive the run, since MPI ends what it began.
/// Thread safety: all members may be called from many threads.
class IncomingRooms : public std::enable_shared_from_this<IncomingRooms> {
 public:
  [[nodiscard]] static std::shared_ptr<IncomingRooms> of(RunStore& store) {
    return std::shared_ptr<IncomingRooms>(new IncomingRooms(store));
  }

  /// Returns a ticket for a block of this size, or null if there is no room, or after close().
  [[nodiscard]] std::shared_ptr<void> take(std::uint64_t encoded_bytes);
  /// Returns the reservation that the ticket stands for, or an empty one if the ticket is null, or
  /// after close().  The ticket counts for is_empty() until it is destroyed.
  [[nodiscard]] MemoryBudget::Reservation claim(const std::shared_ptr<void>& ticket);
  /// True if there are tickets.
  [[nodiscard]] bool is_empty() const;
  /// Gives back all reservations, and takes no more.
  void close();

 private:
  struct Ticket;

  explicit IncomingRooms(RunStore& store) : store_(&store) {}
  void forget(std::uint64_t number);

  mutable std::mutex mutex_;  ///< guards the next lines
  RunStore* store_;           ///< null after close()
  std::uint64_t next_ = 0;
  std::map<std::uint64_t, MemoryBudget::Reservation> rooms_;  ///< by ticket
};

}  // namespace mw::engine
