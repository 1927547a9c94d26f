// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups of finished windows become durable: blocks first, then the record that names them.
#include <algorithm>
#include <utility>

#include "engine/store/run_store.h"
#include "kernels/core/error.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {

bool RunStore::group_is_full() const {
  return journal_ != nullptr &&
         (group_.windows.size() >= limits_.windows || Clock::now() - group_since_ >= limits_.age);
}

/// Returns nothing when the blocks here are of no use.
std::optional<JournalRecord> RunStore::close_group(std::vector<Extent>& retired) {
  const std::lock_guard lock(mutex_);
  if (torn_) return std::nullopt;
  Group group = std::exchange(group_, {});
  group_since_ = Clock::now();
  sort_distinct(group.slots);
  JournalRecord record;
  for (std::uint64_t slot : group.slots) {
    // An empty one has become a part of a later march's block, which is in this group as well.
    if (!table_.at(slot).empty()) {
      record.blocks.push_back(table_.record(slot));
    } else if (router_ != nullptr) {
      record.blocks.push_back({.slot = slot, .extent = {}});  // or it has gone to another process
    }
  }
  std::sort(group.windows.begin(), group.windows.end());
  record.windows = std::move(group.windows);
  retired = table_.take_retired();
  return record;
}

void RunStore::write_group() {
  if (broken_) return;
  broken_ = true;  // until all went well
  std::vector<Extent> retired;
  const std::optional<JournalRecord> record = close_group(retired);
  if (!record) return;
  if (!record->windows.empty()) {
    disk_->sync();
    journal_->append(*record);
  }
  const std::lock_guard lock(mutex_);
  for (const Extent& extent : retired) disk_->release(extent);
  broken_ = false;
}

void RunStore::save() {
  if (journal_ == nullptr || router_ != nullptr) return;
  const std::lock_guard turn(saving_);
  write_group();
}

void RunStore::pause() {
  const std::lock_guard lock(mutex_);
  paused_ = true;
}

bool RunStore::is_quiet() const {
  const std::lock_guard lock(mutex_);
  return visiting_ == 0;
}

/// Always writes a record, so that the number of records is that of checkpoints.
void RunStore::checkpoint() {
  const std::lock_guard turn(saving_);
  const std::optional<JournalRecord> record = close_group(retired_);
  if (!record) throw Error(ErrorKind::kResource, "memory ran out while blocks were replaced");
  disk_->sync();
  journal_->append(*record);
}

void RunStore::go_on() {
  const std::lock_guard lock(mutex_);
  for (const Extent& extent : retired_) disk_->release(extent);
  retired_.clear();
  paused_ = false;
}

void RunStore::note_done(const WindowKey& key, bool is_own) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t window = layout_.window(key);
  done_.insert(window);
  if (!is_own) return;
  group_.windows.push_back(window);
  ++resumed_windows_;
}

bool RunStore::has_saved_work() const {
  return journal_ != nullptr && journal_->records() > 0;
}

StoreFacts RunStore::facts() const {
  const std::lock_guard lock(mutex_);
  return {.blocks_spilled = table_.evicted(),
          .bytes_written = table_.bytes_written(),
          .bytes_read = bytes_read_,
          .resumed_windows = resumed_windows_};
}

}  // namespace mw::engine
