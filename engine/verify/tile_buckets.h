// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What belongs to each tile of a mesh or a volume, in temporary files.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/file/scratch/packed_scratch.h"

namespace mw::engine {

/// Records of tiles that one thread found, those of a tile in their order.
/// Memory: a batch or less for each tile, and what is packed.  Thread safety: none.
template <typename Record>
class TileShares {
 public:
  /// What a tile gets: first what is packed.
  struct Share {
    std::uint32_t tile = 0;
    std::vector<io::PackedBatch> packed{};
    std::vector<Record> records{};
  };

  void add(std::uint32_t tile, const Record& record) {
    Share& share = share_of(tile);
    share.records.push_back(record);
    if (share.records.size() == kBatch) pack(share);
  }
  /// Packs lists of 256 records and more.
  void pack() {
    for (Share& share : shares_) {
      if (share.records.size() >= kWorthPacking) pack(share);
    }
  }
  [[nodiscard]] const std::vector<Share>& shares() const { return shares_; }

 private:
  static constexpr std::size_t kBatch = 4096;
  static constexpr std::size_t kWorthPacking = 256;

  Share& share_of(std::uint32_t tile) {
    if (shares_.empty() || shares_[last_].tile != tile) {
      const auto [place, is_new] = places_.try_emplace(tile, shares_.size());
      if (is_new) shares_.push_back({.tile = tile});
      last_ = place->second;
    }
    return shares_[last_];
  }

  static void pack(Share& share) {
    share.packed.push_back(io::PackedScratch<Record>::pack(share.records));
    share.packed.back().bytes.shrink_to_fit();
    share.records = {};
  }

  std::vector<Share> shares_;
  std::unordered_map<std::uint32_t, std::size_t> places_;  ///< of the tiles in shares_
  std::size_t last_ = 0;
};

/// Holds a list of records for each tile, in the order in which they were added.
/// Memory: `memory_bytes` or 32 records a tile, and 24 bytes each time that a tile's share fills
/// up or was packed before.  Disk: a third of what the records take in memory, or half.
/// Thread safety: one thread adds, or several load and take.  ERRORS: see io::ScratchFile.
template <typename Record>
class TileBuckets {
 public:
  TileBuckets(const std::filesystem::path& folder, std::uint32_t tiles, std::uint64_t memory_bytes)
      : file_(folder),
        tiles_(tiles),
        max_(std::clamp<std::size_t>(memory_bytes / (sizeof(Record) * std::max(tiles, 1U)), kFewest,
                                     kMax)) {}

  void add(std::uint32_t tile, const Record& record) {
    Tile& t = tiles_[tile];
    t.waiting.push_back(record);
    if (t.waiting.size() == max_) pack(t);
  }
  void add(const TileShares<Record>& found) {
    for (const auto& share : found.shares()) {
      Tile& t = tiles_[share.tile];
      if (!share.packed.empty() && !t.waiting.empty()) pack(t);
      for (const io::PackedBatch& batch : share.packed) t.chunks.push_back(file_.append(batch));
      for (const Record& record : share.records) add(share.tile, record);
    }
  }

  [[nodiscard]] std::uint64_t count(std::uint32_t tile) const {
    std::uint64_t sum = tiles_[tile].waiting.size();
    for (const io::PackedChunk& chunk : tiles_[tile].chunks) sum += chunk.records;
    return sum;
  }

  /// Adds the tile's records to a list.
  void load(std::uint32_t tile, std::vector<Record>& out) const {
    const Tile& t = tiles_[tile];
    out.reserve(out.size() + count(tile));
    for (const io::PackedChunk& chunk : t.chunks) file_.read(chunk, out);
    out.insert(out.end(), t.waiting.begin(), t.waiting.end());
  }

  /// Adds the tile's records to a list and lets go of them, on disk, too.
  void take(std::uint32_t tile, std::vector<Record>& out) {
    load(tile, out);
    for (const io::PackedChunk& chunk : tiles_[tile].chunks) file_.give_up(chunk);
    tiles_[tile] = {};
  }

 private:
  static constexpr std::size_t kFewest = 32;
  static constexpr std::size_t kMax = 4096;

  struct Tile {
    std::vector<Record> waiting;
    std::vector<io::PackedChunk> chunks;
  };

  void pack(Tile& t) {
    t.chunks.push_back(file_.append(io::PackedScratch<Record>::pack(t.waiting)));
    t.waiting.clear();
  }

  io::PackedScratch<Record> file_;
  std::vector<Tile> tiles_;
  std::size_t max_;
};

}  // namespace mw::engine
