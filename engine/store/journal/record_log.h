// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file of records that only grows and of which a kill leaves whole records.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/store/journal/work_file.h"

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

}  // namespace mw::engine
