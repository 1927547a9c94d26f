// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file of records that only grows and of which a kill leaves whole records; and the journal in
// it: which windows are done, and where their blocks are.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/store/journal/work_file.h"
#include "engine/store/table/segment_file.h"

namespace mw::engine {

/// What a log holds.
struct LogKind {
  std::uint64_t magic = 0;    ///< its first 8 bytes, little-endian
  const char* name = "";      ///< what errors call it
  const char* expected = "";  ///< what they say where it begins otherwise
};

/// The file has 8 bytes that say what it is, then records: length and CRC-32 in 4 bytes each, then
/// bytes of that length.  A record that is not whole ends the log and does not count; zeros may
/// follow.  Thread safety: read() may run beside everything, the others one at a time.
class RecordLog {
 public:
  using UseRecord = std::function<void(std::uint64_t at, std::span<const std::byte> record)>;
  /// Returns whether the record counts.
  using TakeRecord = std::function<bool(std::uint64_t at, std::span<const std::byte> record)>;

  /// Writes the first 8 bytes if the file is empty, or if a run was stopped while it did so.
  /// ERRORS: DamagedWork when the file begins otherwise.
  RecordLog(std::unique_ptr<WorkFile> file, const LogKind& kind);

  /// Calls take for the next record and returns its answer; false where no whole record is left.
  bool next(const TakeRecord& take);
  /// Cuts off what is behind the records so far.
  /// ENSURES: these records survive a power cut, also those that a killed run had not synced.
  /// REQUIRES: it is called once, before append().
  void cut();
  /// Calls use for all records in their order, and cuts off what is not whole behind them.
  void replay(const UseRecord& use);
  /// Returns where the record is.  It is durable after sync().
  std::uint64_t append(std::span<const std::byte> record);
  void sync() { file_->sync(); }
  /// Makes the file end where its last record does.
  void trim() { file_->resize(end_); }
  /// REQUIRES: a place that replay() or append() gave.
  void read(std::uint64_t at, const UseBytes& use) const;

  /// Returns where the last record ends.
  [[nodiscard]] std::uint64_t bytes() const { return end_; }

 private:
  std::unique_ptr<WorkFile> file_;
  std::uint64_t end_ = 0;
};

/// Where a block's bytes are.
struct JournalBlock {
  std::uint64_t slot = 0;  ///< RunLayout::slot
  Extent extent;
  std::uint32_t sum = 0;           ///< the checksum that the bytes hold, sum_of()
  std::uint64_t memory_bytes = 0;  ///< the size of the decoded block

  friend bool operator==(const JournalBlock&, const JournalBlock&) = default;
};

/// A group of windows whose results become visible together; its blocks are as all of these windows
/// leave them.  A listed block replaces what earlier records say of it, and is gone if its size is
/// 0; a block of a later march that is listed for the first time replaces its parts, too.
struct JournalRecord {
  std::vector<std::uint64_t> windows;  ///< RunLayout::window
  std::vector<JournalBlock> blocks;

  friend bool operator==(const JournalRecord&, const JournalRecord&) = default;
};

/// A RecordLog that begins with "MWJRNL" and the version of this layout, 0 1.  All numbers of a
/// record are varints (engine/store/codec/byte_codes.h):
///
///     number of the record (0, 1, ...)
///     windows; their numbers
///     blocks; for each slot, offset, size, checksum, decoded size
///
/// A record with a wrong number ends the journal as one that is not whole does.
class Journal {
 public:
  /// Opens a journal, or begins one in an empty file.
  /// ERRORS: mw::Error(kInput) when the file is something else; those of WorkFile.
  explicit Journal(std::unique_ptr<WorkFile> file);

  /// Calls `use` for every whole record, in order, and cuts off the rest.
  /// ENSURES: the records survive a power cut, even those of a run that was killed before it synced
  /// them; the space of blocks that they replace may be used again.
  void replay(const std::function<void(const JournalRecord&)>& use);
  /// Calls `use` for the first `count` records, and leaves the journal as it is.
  /// ERRORS: mw::Error(kInput) when there are fewer.
  void scan(std::uint64_t count, const std::function<void(const JournalRecord&)>& use);
  /// ENSURES: on return the record survives a power cut.
  /// REQUIRES: replay() was called, and not scan(); what the record points to has been synced.
  void append(const JournalRecord& record);

  /// Returns the number of whole records.  REQUIRES: replay() or scan() was called.
  [[nodiscard]] std::uint64_t records() const { return records_; }

 private:
  /// Returns false at the end of the journal.
  bool read_next(JournalRecord& record);

  RecordLog log_;
  std::uint64_t records_ = 0;
};

}  // namespace mw::engine
