// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Records that wait in a temporary file until their tile's turn comes.
#pragma once

#include <algorithm>
#include <mutex>
#include <span>
#include <type_traits>
#include <vector>

#include "io/file/scratch/scratch_file.h"

namespace mw::engine {

/// Holds a list of records for each tile, in the order in which they were added.
/// Memory: `memory_bytes` or 32 records a tile, and 16 bytes each time that a tile's share fills
/// up.
/// Thread safety: one thread adds, or several load.  ERRORS: see io::ScratchFile.
template <typename Record>
class TileBuckets {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  TileBuckets(const std::filesystem::path& folder, std::uint32_t tiles, std::uint64_t memory_bytes)
      : file_(folder),
        tiles_(tiles),
        max_(std::clamp<std::size_t>(memory_bytes / (sizeof(Record) * std::max(tiles, 1U)), kFewest,
                                     kMax)) {}

  void add(std::uint32_t tile, const Record& record) {
    Tile& t = tiles_[tile];
    t.waiting.push_back(record);
    if (t.waiting.size() < max_) return;
    t.chunks.push_back({file_.size(), t.waiting.size()});
    file_.append(std::as_bytes(std::span(t.waiting)));
    t.waiting.clear();
  }

  [[nodiscard]] std::uint64_t count(std::uint32_t tile) const {
    std::uint64_t sum = tiles_[tile].waiting.size();
    for (const Chunk& chunk : tiles_[tile].chunks) sum += chunk.records;
    return sum;
  }

  /// Adds the tile's records to a list.
  void load(std::uint32_t tile, std::vector<Record>& out) const {
    const Tile& t = tiles_[tile];
    out.reserve(out.size() + count(tile));
    const std::lock_guard lock(mutex_);
    for (const Chunk& chunk : t.chunks) {
      const std::size_t first = out.size();
      out.resize(first + chunk.records);
      file_.read_at(chunk.offset, std::as_writable_bytes(std::span(out).subspan(first)));
    }
    out.insert(out.end(), t.waiting.begin(), t.waiting.end());
  }

 private:
  static constexpr std::size_t kFewest = 32;
  static constexpr std::size_t kMax = 4096;

  struct Chunk {
    std::uint64_t offset = 0;
    std::uint64_t records = 0;
  };
  struct Tile {
    std::vector<Record> waiting;
    std::vector<Chunk> chunks;
  };

  mutable std::mutex mutex_;
  mutable io::ScratchFile file_;
  std::vector<Tile> tiles_;
  std::size_t max_;
};

}  // namespace mw::engine
