// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The blocks of a whole run under one memory budget, and what of them survives a kill.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "engine/store/block_keeper.h"
#include "engine/store/journal/journal.h"
#include "engine/store/memory_budget.h"
#include "engine/store/table/block_table.h"
#include "engine/window/block_store.h"

namespace mw::engine {

/// Finished windows become durable a group at a time.  This says when a group is full; the result
/// does not depend on it.
struct GroupCommit {
  std::uint64_t windows = 1 << 12;  ///< the most windows of a group, whose record is in memory
  std::chrono::milliseconds age{10'000};  ///< the longest time between two groups
};

/// Takes blocks to the processes that need them next.
/// Thread safety: all members may be called from many threads.
class BlockRouter {
 public:
  virtual ~BlockRouter() = default;
  /// True if the next user of this version is here.
  [[nodiscard]] virtual bool stays(const BlockVersion& version) const = 0;
  /// Takes over a version whose next user is elsewhere.
  virtual void send(const BlockVersion& version, BlockPin block) = 0;
  /// Called with versions that stay and can be taken from then on.
  virtual void committed(std::span<const BlockVersion> versions) = 0;
  /// True if blocks that are being sent or received hold memory.
  [[nodiscard]] virtual bool is_carrying() const = 0;
};

struct StoreFacts {
  std::uint64_t blocks_spilled = 0;  ///< written to make room
  std::uint64_t bytes_written = 0;
  std::uint64_t bytes_read = 0;
  std::uint64_t resumed_windows = 0;  ///< done when the run began
};

/// Keeps encoded blocks in memory as long as the budget allows; those that are needed last leave
/// first.  With a work folder they go to disk, and groups of finished windows become durable
/// together: first the blocks, then the one record that names them.  Without work folder and keeper
/// everything stays in memory.
///
/// A block of a later march that no window has committed yet is made of its parts when it is taken;
/// they are forgotten when its first window commits.
///
/// Thread safety: that of BlockStore.  Encoding, decoding and syncing happen outside the lock.
class RunStore {
 public:
  /// Goes on from what the journal among `files` holds.
  /// router is null where all windows are visited here.  With one, work becomes durable by
  /// checkpoint() alone.
  /// keeper is null where nothing is kept.  With one, `files` is null: blocks that leave memory are
  /// read again from what is kept, and those that are not kept are spilled.
  /// REQUIRES: layout, budget, files (null: no work folder), router and keeper outlive it.
  /// ERRORS: mw::Error(kResource) when the index alone exceeds the budget; kInput when the journal
  /// is damaged.
  RunStore(const RunLayout& layout, MemoryBudget& budget, WorkFiles* files,
           const GroupCommit& group = {}, BlockRouter* router = nullptr,
           BlockKeeper* keeper = nullptr);
  ~RunStore();

  /// Returns the store as the windows of one march see it.  It lives as long as this.
  [[nodiscard]] BlockStore& march(std::uint32_t march);

  /// Spills blocks until the reservation fits; returns nothing when it does not fit then.
  [[nodiscard]] std::optional<MemoryBudget::Reservation> try_reserve(Purpose purpose,
                                                                     std::uint64_t bytes);
  /// Reserves as try_reserve() does.  ERRORS: those of MemoryBudget::fail().
  [[nodiscard]] MemoryBudget::Reservation reserve(Purpose purpose, std::uint64_t bytes,
                                                  double grows = 0);

  /// Returns what a block of this encoded size takes of the budget.
  [[nodiscard]] static std::uint64_t cost_of(std::uint64_t encoded_bytes);
  /// Takes in a version that another process left; `bytes` are those of its pin there.
  /// room is what was reserved for it: cost_of(bytes) for blocks, or nothing.  Where windows in
  /// flight leave no room, it goes to disk at once.
  /// ERRORS: mw::Error(kResource) when there is no disk then, or no room for the index.
  void receive(const BlockVersion& version, std::vector<std::byte> bytes,
               std::uint64_t memory_bytes, MemoryBudget::Reservation room = {});

  /// These are for a store with a router.  No window starts from pause() until go_on().  Once none
  /// runs (is_quiet()) and no block is on its way, checkpoint() makes what is here durable as one
  /// record; go_on() then frees the bytes that only older records point to.
  /// ERRORS of checkpoint(): mw::Error(kResource) when memory ran out in the middle of a commit.
  void pause();
  [[nodiscard]] bool is_quiet() const;
  void checkpoint();
  void go_on();
  /// Notes a window that an earlier run has done.  is_own says that this process is the one that
  /// visits it, so that the next record names it.  REQUIRES: nothing was committed.
  void note_done(const WindowKey& key, bool is_own);

  /// Marks the window as done without a visit: its blocks, in their order, are those at these
  /// places.  REQUIRES: a keeper and no router; what a visit of the window requires.
  void adopt(const WindowKey& key, std::span<const KeptPlace> places);

  /// Makes durable what is finished.  Does nothing without a work folder, or after an error in an
  /// earlier group or in the middle of a commit.
  void save();
  /// True if another run can go on from what this one has saved.
  [[nodiscard]] bool has_saved_work() const;

  [[nodiscard]] StoreFacts facts() const;

 private:
  class March;
  struct Source;
  struct Group {
    std::vector<std::uint64_t> windows;
    std::vector<std::uint64_t> slots;
  };

  [[nodiscard]] bool admit(const WindowKey& key, std::uint64_t bytes,
                           const MostBytes& most = nullptr);
  [[nodiscard]] bool will_give_back() const;
  [[nodiscard]] std::vector<std::optional<BlockMesh>> take(const WindowKey& key) const;
  void commit(const WindowKey& key, std::vector<BlockMesh> blocks);
  [[nodiscard]] BlockMesh load(const BlockKey& key) const;
  [[nodiscard]] bool is_done(const WindowKey& key) const;
  [[nodiscard]] std::uint64_t memory_bytes_of(std::span<const BlockKey> keys) const;
  void prefetch(const WindowKey& key) const;

  void restore();
  /// Returns the source of memory for a table that grows with the blocks that are here.
  [[nodiscard]] TableRoom room_for_index();
  /// Finds where the block or its parts are.  REQUIRES: the store is locked.
  void find(const BlockKey& key, std::vector<Source>& out) const;
  [[nodiscard]] BlockMesh read(const Source& source) const;
  [[nodiscard]] std::optional<BlockMesh> assemble(const BlockKey& key,
                                                  const std::vector<Source>& sources) const;
  /// Encodes a block, whose memory comes out of `room` if it fits there.
  [[nodiscard]] BlockPin encode(const BlockKey& key, const BlockMesh& mesh,
                                MemoryBudget::Reservation& room);
  /// places is empty where nothing is kept, pins where nothing is in memory.
  void replace(const WindowKey& key, std::span<const BlockKey> blocks, std::vector<BlockPin>& pins,
               std::span<const KeptPlace> places);
  [[nodiscard]] bool stays(const WindowKey& key, const BlockKey& block) const {
    return router_ == nullptr || router_->stays({block, key});
  }
  void send_away(const WindowKey& key, std::span<const BlockKey> blocks,
                 std::vector<BlockPin> pins);
  [[nodiscard]] bool group_is_full() const;
  void write_group();
  [[nodiscard]] std::optional<JournalRecord> close_group(std::vector<Extent>& retired);

  using Clock = std::chrono::steady_clock;

  const RunLayout& layout_;
  MemoryBudget& budget_;
  const GroupCommit limits_;
  BlockRouter* router_;
  BlockKeeper* keeper_;
  MemoryBudget::Reservation index_room_;
  std::vector<std::unique_ptr<March>> marches_;

  mutable std::mutex mutex_;  ///< guards the next lines
  DoneWindows done_;
  std::unique_ptr<SegmentFile> disk_;
  BlockTable table_;
  std::map<std::uint64_t, MemoryBudget::Reservation> in_flight_;  ///< by window
  std::uint64_t visiting_ = 0;  ///< windows that are visited or whose blocks are not all handed on
  bool paused_ = false;
  /// A window's blocks are being replaced.  It stays so when memory runs out in the middle: then
  /// the blocks here are of no use, and no record may follow those that were saved before.
  bool torn_ = false;
  std::vector<Extent> retired_;  ///< the extents that go_on() releases
  Group group_;
  Clock::time_point group_since_ = Clock::now();

  std::mutex saving_;  ///< taken before mutex_; guards the journal
  std::unique_ptr<Journal> journal_;
  std::atomic<bool> broken_ = false;  ///< a group could not be written; no other may follow
  std::uint64_t resumed_windows_ = 0;
  mutable std::atomic<std::uint64_t> bytes_read_ = 0;
};

struct StoreOptions {
  std::uint64_t memory = MemoryBudget::kUnlimited;  ///< bytes, for the whole process
  std::uint64_t memory_beside = 0;  ///< bytes of --memory that were taken off for something else
  double buffers_grow = 0;  ///< the part of --memory that buffers of the output may take of it
  std::filesystem::path workdir;  ///< if empty, everything stays in memory
  bool resume = false;            ///< go on from what workdir holds
  /// The folder stays when the mesh is complete, for a caller that has more to write.
  bool stays = false;
  bool is_scratch = false;  ///< nothing stays when the run ends early
  /// Lines "name = value" that a run must have in common with the one that it goes on from.  The
  /// engine adds those of the volume and of the settings: identity_text().
  std::string identity;
  GroupCommit group;
  /// Called when a run that ends early leaves work in the folder.
  std::function<void()> kept;
};

}  // namespace mw::engine
