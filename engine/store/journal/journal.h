// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The journal: which windows are done, and where their blocks are, in records that count whole.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/store/journal/record_log.h"
#include "engine/store/table/extent_allocator.h"

namespace mw::engine {

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
