// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder of shards, from which chunks are read by their numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/chunks/chunk_cache.h"
#include "io/volume/precomputed/sharding.h"

namespace mw::io {

/// Thread safety: all members may be called from many threads.
class ShardFolder {
 public:
  ShardFolder(std::filesystem::path folder, const Sharding& sharding, Index3 grid);

  /// The chunk's bytes as the shard has them, maybe gzipped; empty: there is no such chunk.
  /// most: the most bytes that they may be.
  /// ERRORS: mw::Error(kInput) naming the shard when it is damaged, or the chunk is larger.
  [[nodiscard]] std::optional<std::vector<std::byte>> read(std::uint64_t chunk,
                                                           std::uint64_t max) const;
  /// The shard that a chunk is in, if it is there.
  [[nodiscard]] std::filesystem::path path_of(std::uint64_t chunk) const;
  /// The most that read() takes in memory beside what it returns, indices that are kept included.
  [[nodiscard]] std::uint64_t scratch_bytes() const;

 private:
  [[nodiscard]] std::optional<Chunk> load_index(const std::filesystem::path& path,
                                                std::uint64_t minishard) const;

  std::filesystem::path folder_;
  Sharding sharding_;
  std::uint64_t max_index_bytes_;  ///< of one minishard, unpacked
  mutable ChunkCache indices_;     ///< as arrays of ShardEntry, by shard and minishard
};

}  // namespace mw::io
