// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checkpoint that the processes of an earlier run left in their folders, to go on from.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <vector>

#include "engine/store/journal/journal.h"
#include "engine/store/run_layout.h"

namespace mw::engine {

/// A block in the version of the last epoch.
struct SavedBlock {
  BlockVersion version;
  std::size_t folder = 0;
  JournalBlock place;
};

/// Reads the journals of all processes up to the last epoch that counts.  Many processes may do so
/// at once; no file is made, and none that holds records is changed.
class SavedRun {
 public:
  /// folders has one for each process of that run; `epochs` records of each journal count.
  /// ERRORS: mw::Error(kInput) when the folders are damaged, or do not fit together.
  SavedRun(const RunLayout& layout, std::vector<std::filesystem::path> folders,
           std::uint64_t epochs);

  [[nodiscard]] const DoneWindows& done() const { return done_; }
  /// Calls `use` for all blocks that some window or the output still needs, ascending.
  void for_each_block(const std::function<void(const SavedBlock&)>& use) const;
  /// Returns the bytes of a block.  ERRORS: mw::Error(kInput) when they differ from those written.
  [[nodiscard]] std::vector<std::byte> read(const SavedBlock& block) const;

 private:
  [[nodiscard]] std::unique_ptr<WorkFile> open(std::size_t folder, const char* file) const;
  void scan(std::size_t folder, std::uint64_t epochs);
  void take(std::size_t folder, const JournalBlock& block,
            std::map<std::uint64_t, JournalBlock>& blocks) const;
  [[nodiscard]] WindowKey last_done_over(const BlockKey& key) const;

  const RunLayout& layout_;
  std::vector<std::filesystem::path> folders_;
  std::vector<std::unique_ptr<WorkFile>> files_;  ///< files of blocks, by folder
  DoneWindows done_;
  std::map<std::uint64_t, std::pair<std::size_t, JournalBlock>> blocks_;  ///< by slot
};

}  // namespace mw::engine
