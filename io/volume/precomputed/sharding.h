// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where chunks are in "neuroglancer_uint64_sharded_v1", and a folder of such shards, from which
// they are read by their numbers.
// Format: https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/sharded.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/chunks/chunked_volume.h"
#include "io/store/place.h"
#include "kernels/core/index.h"

namespace mw::io {

/// Returns the low 64 of the 128 bits of MurmurHash3_x86_128 (A. Appleby, public domain), of the 8
/// bytes of key, least significant first, with seed 0.
[[nodiscard]] std::uint64_t murmur_hash(std::uint64_t key);

/// The member "sharding" of a scale (neuroglancer's "precomputed" format, sharding).
struct Sharding {
  bool hashed = false;        ///< by murmurhash3_x86_128, else by the identity
  int preshift_bits = 0;      ///< 0 to 64; low bits of a chunk's number that choose nothing
  int minishard_bits = 0;     ///< 0 to 32
  int shard_bits = 0;         ///< 0 to 64 - minishard_bits
  bool packed_index = false;  ///< minishard indices are gzipped
  bool packed_data = false;   ///< chunks are gzipped
};

/// Returns the number of the chunk at a place of the grid, its "compressed Morton code": bits of x,
/// y and z in turn, without those of an axis where the grid has no more of them.
/// REQUIRES: cell inside the grid; grid extents at most 2^20.
[[nodiscard]] std::uint64_t morton_code(Index3 cell, Index3 grid);

struct ShardPosition {
  std::uint64_t shard = 0;
  std::uint64_t minishard = 0;
};
[[nodiscard]] ShardPosition position_of(const Sharding& sharding, std::uint64_t chunk);

/// Returns the name of a shard's file, such as "0a.shard".
[[nodiscard]] std::string shard_file_name(const Sharding& sharding, std::uint64_t shard);

/// Returns the bytes of the index that a shard begins with, from whose end offsets count.
[[nodiscard]] std::uint64_t shard_index_bytes(const Sharding& sharding);

/// Returns the most chunks of the grid that one minishard can hold.  With murmurhash3 it is eight
/// times the average and 64 groups more, which chance never reaches.
[[nodiscard]] std::uint64_t max_in_minishard(const Sharding& sharding, Index3 grid);

/// A chunk in a shard.
struct ShardEntry {
  std::uint64_t chunk = 0;
  std::uint64_t offset = 0;  ///< in bytes from the end of the shard's index
  std::uint64_t size = 0;
};

/// Decodes a minishard's index: three rows of n numbers, of which chunks and offsets are coded as
/// differences.  data_bytes is the number of the shard's bytes behind its index.
/// ENSURES: every entry lies within them.
/// ERRORS: mw::Error(kInput) naming `name` when one does not.
[[nodiscard]] std::vector<ShardEntry> parse_minishard_index(std::span<const std::byte> bytes,
                                                            std::uint64_t data_bytes,
                                                            std::string_view name);

/// Thread safety: all members may be called from many threads.
class ShardFolder {
 public:
  ShardFolder(Place folder, const Sharding& sharding, Index3 grid);

  /// Returns the chunk's bytes as the shard has them, maybe gzipped; null: there is no such chunk.
  /// Errors call them `name`; `max` is the most bytes that they may be.
  /// ERRORS: mw::Error(kInput) naming the shard when it is damaged, or the chunk is larger.
  [[nodiscard]] std::shared_ptr<const ByteSource> find(std::uint64_t chunk, std::string name,
                                                       std::uint64_t max) const;
  /// Returns where the shard is that a chunk would be in, whether it exists or not.
  [[nodiscard]] Place path_of(std::uint64_t chunk) const;
  /// Returns the most that find() takes in memory, with the indices that are kept.
  [[nodiscard]] std::uint64_t scratch_bytes() const;

 private:
  [[nodiscard]] std::optional<Chunk> load_index(const Place& path, std::uint64_t minishard) const;

  Place folder_;
  Sharding sharding_;
  std::uint64_t max_index_bytes_;  ///< of one minishard's index, unpacked
  mutable ChunkCache indices_;     ///< arrays of ShardEntry, by shard and minishard
};

}  // namespace mw::io
