// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sends blocks between the processes of a run: each version goes to the one that needs it next,
// which for those of the last march is rank 0.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>

#include "engine/march/arrival_front.h"
#include "engine/store/run_layout.h"
#include "engine/store/run_store.h"
#include "engine/team/blocks/partition.h"
#include "engine/team/team.h"

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

/// What a process has sent.
struct TrafficFacts {
  std::uint64_t blocks = 0;
  std::uint64_t bytes = 0;
};

/// Sends versions whose next user is on another rank, takes in those that come, and counts the
/// inputs of own windows.  No rank asks for a block: it is sent as soon as it is ready.
/// Thread safety: that of BlockRouter for its members; the others are called from one thread.
class BlockTraffic : public BlockRouter {
 public:
  /// The references outlive it.
  BlockTraffic(const RunLayout& layout, Team& team)
      : layout_(layout),
        route_(layout),
        team_(team),
        sent_to_(static_cast<std::size_t>(team.ranks())) {}

  /// While the result lives, blocks that come in go into the store.
  class Attached {
   public:
    Attached(BlockTraffic& traffic, RunStore& store);
    Attached(const Attached&) = delete;
    Attached& operator=(const Attached&) = delete;
    /// ENSURES: the exchange has released all blocks, or never does (Exchange::let_go()), so that
    /// the store and its budget may go.
    ~Attached();

   private:
    BlockTraffic& traffic_;
  };

  /// Must be called before anything is committed.
  void deal(Partition partition) { partition_ = std::move(partition); }

  [[nodiscard]] Arrivals& arrivals() { return arrivals_; }
  [[nodiscard]] bool is_mine(const WindowKey& key) const {
    return partition_.rank_of(key) == team_.rank();
  }
  [[nodiscard]] std::uint32_t inputs(const WindowKey& key) const {
    return static_cast<std::uint32_t>(route_.inputs(key).size());
  }
  [[nodiscard]] TrafficFacts facts() const;

  /// Returns the last number that another rank has signalled; these numbers only grow.
  [[nodiscard]] std::uint64_t signalled() const { return signalled_; }
  /// Return how many parcels were sent to each rank, and how many came into the store here.
  [[nodiscard]] std::vector<std::uint64_t> sent_to() const;
  [[nodiscard]] std::uint64_t received() const { return received_; }
  /// Ends the march and the output of all ranks with this error.
  void end(std::exception_ptr error);

  /// Waits until all blocks of the last march are in the store.  REQUIRES: this is rank 0.
  /// ERRORS: that of the rank that failed.
  void wait_for_output();

  [[nodiscard]] bool stays(const BlockVersion& version) const override;
  void send(const BlockVersion& version, BlockPin block) override;
  void committed(std::span<const BlockVersion> versions) override;
  [[nodiscard]] bool is_carrying() const override {
    return !team_.is_idle() || (rooms_ != nullptr && !rooms_->is_empty());
  }

 private:
  /// ticket is one of rooms_, or null.
  void receive(RunStore& store, const Team::Head& head, std::vector<std::byte> bytes,
               std::shared_ptr<void> ticket);
  [[nodiscard]] int next_rank(const BlockVersion& version) const;
  [[nodiscard]] BlockVersion version_of(const Team::Head& head) const;
  void note(const BlockVersion& version);

  const RunLayout& layout_;
  BlockRoute route_;
  Team& team_;
  Partition partition_;
  Arrivals arrivals_;
  std::atomic<std::uint64_t> signalled_ = 0;
  std::atomic<std::uint64_t> received_ = 0;
  std::atomic<std::uint64_t> bytes_sent_ = 0;
  std::shared_ptr<IncomingRooms> rooms_;  ///< while attached

  mutable std::mutex mutex_;  ///< guards the next lines
  std::condition_variable changed_;
  std::int64_t final_blocks_ = 0;  ///< those that are here
  std::vector<std::uint64_t> sent_to_;
};

/// Predicts how many blocks each rank sends in a run.  A pure function.
[[nodiscard]] std::vector<std::uint64_t> blocks_sent(const RunLayout& layout,
                                                     const Partition& partition, int ranks);

}  // namespace mw::engine
