// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The facts of a folder: what went into visits, what came out, and the bytes of the blocks.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/keep/keep_folder.h"
#include "engine/keep/window_records.h"
#include "engine/store/journal/journal.h"
#include "engine/store/run_layout.h"
#include "engine/store/run_store.h"
#include "engine/store/table/segment_file.h"

namespace mw::engine {

/// The last record of each window, and the bytes that it points to.  Records become durable a group
/// at a time: first their bytes, then the records; only then the bytes that these replace are free.
///
/// Each run has a number, which is higher than those of the runs before it.
///
/// Thread safety: of(), add() and read() may be called from many threads, the others one at a time.
class KeptFacts {
 public:
  /// limits says when a group is full.  The references outlive it.
  /// ERRORS: DamagedWork.
  KeptFacts(KeepFolder& folder, const RunLayout& layout, const GroupCommit& limits);

  /// Returns the durable record of a window.  REQUIRES: the number of a window of the layout.
  [[nodiscard]] std::optional<WindowRecord> of(std::uint64_t window) const;
  /// Adds a record of this run, and the bytes of the blocks that it keeps; returns it with their
  /// place.
  WindowRecord add(WindowRecord record, std::span<const std::byte> packed);
  /// Reads what add() wrote.
  void read(const Extent& extent, const UseBytes& use) const { bytes_.read(extent, use); }
  /// True if bytes of the window were given up for want of space (shrink_to()).
  [[nodiscard]] bool is_dropped(std::uint64_t window) const { return dropped_[window]; }
  [[nodiscard]] bool has_dropped() const;
  /// True if there are records.
  [[nodiscard]] bool any() const;

  /// ENSURES: what was added so far survives a power cut.
  void save();
  /// Adds what other processes kept in KeepFolder::parts(), and removes these folders.
  /// Returns how many records of each march they had.
  /// REQUIRES: no process is at work in them.  ERRORS: DamagedWork.
  std::vector<std::uint64_t> take_over_parts();
  /// Gives up bytes, in the order of drop_order(), until the folder takes no more than
  /// folder_bytes or nothing else may go.  Memory: up to 24 bytes a window, the list of gaps, and a
  /// group of records.
  void shrink_to(std::uint64_t folder_bytes);
  /// Makes the files end where their last record and extent do.  Nothing is added afterwards.
  /// Memory: that of shrink_to().
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void replay();
  /// Calls use for the record of each window that has one, windows ascending.
  void each(const std::function<void(const WindowRecord& record)>& use) const;
  /// ERRORS: DamagedWork.
  [[nodiscard]] WindowRecord checked(std::span<const std::byte> bytes) const;
  void put(const WindowRecord& record, const std::optional<WindowRecord>& old);
  void take_over(const std::filesystem::path& part, std::vector<std::uint64_t>& by_march);
  void replace(const WindowRecord& record, const WindowRecord& old);
  [[nodiscard]] std::optional<Extent> copy_down(const Extent& extent);
  void write_group();
  [[nodiscard]] bool drop(std::uint64_t bytes);
  void move_down();
  void compact_log();

  KeepFolder& folder_;
  const RunLayout& layout_;
  GroupCommit limits_;
  std::uint32_t run_ = 1;

  mutable std::mutex mutex_;  ///< guards the next lines
  SegmentFile bytes_;
  std::vector<std::uint64_t> record_at_;  ///< by window: 1 more than where its record is; 0 if none
  std::vector<bool> dropped_;             ///< by window
  std::vector<WindowRecord> group_;       ///< records that are not durable yet
  std::vector<Extent> superseded_;        ///< extents that records of the group replace
  Clock::time_point group_since_ = Clock::now();
  std::uint64_t live_ = 0;  ///< windows with a record

  std::mutex saving_;  ///< taken before mutex_; guards the log's end
  std::unique_ptr<RecordLog> log_;
  std::uint64_t records_ = 0;  ///< records in the log
  bool broken_ = false;        ///< a group could not be written; no other may follow
};

}  // namespace mw::engine
