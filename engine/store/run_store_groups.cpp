// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Groups of finished windows become durable: blocks first, then the record that names them.
#include <algorithm>
#include <utility>

#include "engine/store/run_store.h"

namespace mw::engine {

bool RunStore::group_is_full() const {
  return journal_ != nullptr &&
         (group_.windows.size() >= limits_.windows || Clock::now() - group_since_ >= limits_.age);
}

JournalRecord RunStore::close_group(std::vector<Extent>& retired) {
  const std::lock_guard lock(mutex_);
  Group group = std::exchange(group_, {});
  group_since_ = Clock::now();
  std::sort(group.slots.begin(), group.slots.end());
  group.slots.erase(std::unique(group.slots.begin(), group.slots.end()), group.slots.end());
  JournalRecord record;
  for (std::uint64_t slot : group.slots) {
    // Empty: it has become a part of a later march's block, which is in this group as well.
    if (!table_.at(slot).empty()) record.blocks.push_back(table_.record(slot));
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
  const JournalRecord record = close_group(retired);
  if (!record.windows.empty()) {
    disk_->sync();
    journal_->append(record);
  }
  const std::lock_guard lock(mutex_);
  for (const Extent& extent : retired) disk_->release(extent);
  broken_ = false;
}

void RunStore::save() {
  if (journal_ == nullptr) return;
  const std::lock_guard turn(saving_);
  write_group();
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
