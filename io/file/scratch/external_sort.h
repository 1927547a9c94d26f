// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sorts more records than memory holds: it writes sorted runs to a temporary file and merges them.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "kernels/core/assert.h"

namespace mw::io {

/// Records of N words, in lexicographic order.
/// Memory: `memory_bytes`, and 100 bytes for each time the records have filled that.
template <std::size_t N>
class ExternalSort {
 public:
  using Record = std::array<std::uint64_t, N>;
  /// Sorts what memory holds.
  using SortHeld = std::function<void(std::span<Record>)>;

  /// Makes a temporary file in `folder` when memory is not enough.  ERRORS: see ScratchFile.
  ExternalSort(
      std::filesystem::path folder, std::size_t memory_bytes,
      SortHeld sort_held = [](std::span<Record> held) { std::sort(held.begin(), held.end()); })
      : folder_(std::move(folder)),
        max_(std::max<std::size_t>(memory_bytes / sizeof(Record), 2)),
        sort_held_(std::move(sort_held)) {}

  void add(const Record& record) {
    if (records_.size() == max_) spill();
    if (records_.size() == records_.capacity()) {
      records_.reserve(std::min(max_, std::max(kFirstRecords, 2 * records_.size())));
    }
    records_.push_back(record);
  }

  /// Calls visit(record) on every record, ascending.  REQUIRES: called once, nothing added after.
  template <class Visit>
  void each(Visit visit) {
    while (const Record* record = next()) visit(*record);
  }

  /// Returns the next record, ascending, which is there until the next call; null behind the last.
  /// REQUIRES: nothing is added after the first call.
  const Record* next() {
    if (!is_sorted_) sort();
    if (!file_ && at_ < records_.size()) return &records_[at_++];
    if (last_ != nullptr && (last_->at < last_->buffer.size() || refill(*last_))) {
      // Records that follow one another are often of one run.
      const bool is_next = queue_.empty() || !IsLater()(last_, queue_.top());
      if (is_next) return &last_->buffer[last_->at++];
      queue_.push(last_);
    }
    if (queue_.empty()) {
      end();
      return nullptr;
    }
    last_ = queue_.top();
    queue_.pop();
    return &last_->buffer[last_->at++];
  }

  /// Calls visit(std::span<const Record>) on each group of records that agree in their first `Keys`
  /// words, ascending.  REQUIRES: as for each().  Memory: the records of one group.
  template <std::size_t Keys, class Visit>
  void each_group(Visit visit) {
    std::vector<Record> group;
    each([&](const Record& record) {
      if (!group.empty() &&
          !std::equal(group[0].begin(), group[0].begin() + Keys, record.begin())) {
        visit(std::span<const Record>(group));
        group.clear();
      }
      group.push_back(record);
    });
    if (!group.empty()) visit(std::span<const Record>(group));
  }

 private:
  static constexpr std::size_t kFirstRecords = 1024;

  /// A sorted run, read through a buffer of its own.
  struct Run {
    std::uint64_t next = 0;  ///< the record of the file that follows the buffer
    std::uint64_t end = 0;
    std::vector<Record> buffer;
    std::size_t at = 0;
  };

  struct IsLater {
    bool operator()(const Run* a, const Run* b) const {
      return a->buffer[a->at] > b->buffer[b->at];
    }
  };

  void spill() {
    if (!file_) file_.emplace(folder_);
    sort_held_(records_);
    file_->append(std::as_bytes(std::span(records_)));
    const std::uint64_t begin = runs_.empty() ? 0 : runs_.back().end;
    runs_.push_back({.next = begin, .end = begin + records_.size(), .buffer = {}, .at = 0});
    records_.clear();
  }

  /// Reads the run's next records into its buffer; false when the run has none left.
  bool refill(Run& run) {
    run.at = 0;
    const std::uint64_t share = std::max<std::uint64_t>(max_ / runs_.size(), 1);
    run.buffer.resize(std::min(share, run.end - run.next));
    file_->read_at(run.next * sizeof(Record), std::as_writable_bytes(std::span(run.buffer)));
    run.next += run.buffer.size();
    return !run.buffer.empty();
  }

  /// Sorts the records where they are, or makes the runs ready to be merged.
  void sort() {
    is_sorted_ = true;
    if (!file_) return sort_held_(records_);
    spill();
    records_ = std::vector<Record>();
    for (Run& run : runs_) {
      if (refill(run)) queue_.push(&run);
    }
  }

  /// Lets go of all records.
  void end() {
    records_ = std::vector<Record>();
    at_ = 0;
    last_ = nullptr;
    runs_ = std::vector<Run>();
    file_.reset();
  }

  std::filesystem::path folder_;
  std::size_t max_;  ///< the most records in memory
  SortHeld sort_held_;
  std::vector<Record> records_;
  std::vector<Run> runs_;
  std::optional<ScratchFile> file_;
  bool is_sorted_ = false;
  std::size_t at_ = 0;   ///< of the records in memory, the next one
  Run* last_ = nullptr;  ///< the run of the record that was returned last
  std::priority_queue<Run*, std::vector<Run*>, IsLater> queue_;
};

}  // namespace mw::io
