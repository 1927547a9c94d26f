// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Chunks of a Zarr array, each in a file of its own or several in a shard.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "io/chunks/chunk.h"
#include "io/chunks/chunked_volume.h"
#include "io/volume/zarr/multiscale.h"
#include "io/volume/zarr/zarr_array.h"

namespace mw::io {

/// Bytes of a shard's file.  Not compared to the size of the file.
struct ShardRange {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// Reads the indices of shards, and keeps those used last.  Thread safety: any.
class ShardIndices {
 public:
  explicit ShardIndices(ShardCoding coding);

  /// shard: its number along x, y and z; path: its file; chunk: its number in the shard along each
  /// axis of the array.
  /// ENSURES: empty when there is no such file, or no such chunk in it.
  /// ERRORS: mw::Error(kInput) naming the file when its index is damaged.
  [[nodiscard]] std::optional<ShardRange> find(Index3 shard, const std::filesystem::path& path,
                                               const std::vector<std::int64_t>& chunk) const;
  /// The most that is kept.
  [[nodiscard]] std::uint64_t max_bytes() const;

 private:
  [[nodiscard]] std::uint64_t index_bytes() const;  ///< with the checksum
  [[nodiscard]] std::optional<Chunk> read(const std::filesystem::path& path) const;
  [[nodiscard]] std::uint64_t offset_of(const std::vector<std::int64_t>& chunk) const;

  ShardCoding coding_;
  mutable ChunkCache kept_;
};

/// A missing file, and a chunk that a shard does not have, are fill values: an error when those are
/// no labels.  An index of a shard is read once and kept with the last used others.
/// REQUIRES: the array is checked, and axes are its.
[[nodiscard]] std::unique_ptr<ChunkSource> zarr_chunks(const std::filesystem::path& folder,
                                                       const ZarrArray& array, const AxisMap& axes);

}  // namespace mw::io
