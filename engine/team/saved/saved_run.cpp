// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Replays the journals of all processes into one table.
#include "engine/team/saved/saved_run.h"

#include <utility>

#include "engine/store/journal/mapped_file.h"
#include "engine/store/journal/run_folder.h"
#include "engine/store/journal/work_file.h"
#include "engine/store/table/block_table.h"

namespace mw::engine {

SavedRun::SavedRun(const RunLayout& layout, std::vector<std::filesystem::path> folders,
                   std::uint64_t epochs)
    : layout_(layout), folders_(std::move(folders)), done_(layout.windows()) {
  for (std::size_t folder = 0; folder < folders_.size(); ++folder) scan(folder, epochs);
}

/// A file that is not there is damage, and is not made, as MappedFile would do.
std::unique_ptr<WorkFile> SavedRun::open(std::size_t folder, const char* file) const {
  if (!std::filesystem::exists(folders_[folder] / file)) {
    throw DamagedWork(folders_[folder].string(), std::string("it has no file ") + file);
  }
  return std::make_unique<MappedFile>(folders_[folder] / file);
}

void SavedRun::scan(std::size_t folder, std::uint64_t epochs) {
  Journal journal(open(folder, kJournalFile));
  std::map<std::uint64_t, JournalBlock> blocks;
  journal.scan(epochs, [&](const JournalRecord& record) {
    for (const JournalBlock& block : record.blocks) take(folder, block, blocks);
    for (std::uint64_t window : record.windows) {
      if (window >= layout_.windows()) {
        throw DamagedWork(folders_[folder].string(), "its journal has a window that there is not");
      }
      done_.insert(window);
    }
  });
  files_.push_back(open(folder, kBlocksFile));
  for (const auto& [slot, block] : blocks) {
    if (block.extent.offset + block.extent.size > files_.back()->size()) {
      throw DamagedWork(folders_[folder].string(), "its journal points to where nothing can be");
    }
    if (!blocks_.emplace(slot, std::pair(folder, block)).second) {
      throw DamagedWork(folders_[folder].string(), "a block is in two folders");
    }
  }
}

/// Does what BlockTable::restore() does; an empty block went to another process or a larger block.
void SavedRun::take(std::size_t folder, const JournalBlock& block,
                    std::map<std::uint64_t, JournalBlock>& blocks) const {
  if (block.slot >= layout_.slots()) {
    throw DamagedWork(folders_[folder].string(), "its journal has a block that there is not");
  }
  if (block.extent.size == 0) {
    blocks.erase(block.slot);
  } else {
    blocks[block.slot] = block;
  }
}

WindowKey SavedRun::last_done_over(const BlockKey& key) const {
  const WindowOrder order = layout_.order(key.march);
  std::optional<Index3> last;
  for_each_index(layout_.windows_over(key), [&](Index3 w) {
    if (!done_.contains(layout_.window({key.march, w}))) return;
    if (!last || order.rank(w) > order.rank(*last)) last = w;
  });
  if (!last) throw DamagedWork(name(key), "no window has left it, but it is there");
  return {key.march, *last};
}

void SavedRun::for_each_block(const std::function<void(const SavedBlock&)>& use) const {
  for (const auto& [slot, found] : blocks_) {
    const auto& [folder, block] = found;
    const BlockKey key = layout_.key(slot);
    use({{key, last_done_over(key)}, folder, block});
  }
}

std::vector<std::byte> SavedRun::read(const SavedBlock& block) const {
  std::vector<std::byte> out;
  files_[block.folder]->read(block.place.extent.offset, block.place.extent.size,
                             [&](std::span<const std::byte> bytes) {
                               if (bytes.size() >= 8 && sum_of(bytes) == block.place.sum) {
                                 out.assign(bytes.begin(), bytes.end());
                               }
                             });
  if (out.empty()) {
    throw DamagedWork(folders_[block.folder].string(),
                      name(block.version.block) + " is not what was written");
  }
  return out;
}

}  // namespace mw::engine
