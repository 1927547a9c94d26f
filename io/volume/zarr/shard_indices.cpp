// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the indices of shards.
#include "io/volume/zarr/shard_indices.h"

#include <algorithm>

#include "io/chunks/chunk_bytes.h"
#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/zarr/chunk_coding.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kEntryBytes = 16;  // offset and length
constexpr std::uint64_t kNone = UINT64_MAX;

/// Enough for 32 shards of 4096 chunks, and for one of any number with what keeping it costs.
std::uint64_t kept_bytes(std::uint64_t index) {
  return std::max<std::uint64_t>(2U << 20U, index + 1024);
}

std::uint64_t product(const std::vector<std::int64_t>& extents) {
  std::uint64_t out = 1;
  for (const std::int64_t extent : extents) out *= static_cast<std::uint64_t>(extent);
  return out;
}

/// Shards of a volume are at most that many along an axis.
std::uint64_t number_of(Index3 shard) {
  constexpr Index3 kAll{kMaxAxisVoxels, kMaxAxisVoxels, kMaxAxisVoxels};
  return static_cast<std::uint64_t>(Box3{{0, 0, 0}, kAll}.offset(shard));
}

}  // namespace

ShardIndices::ShardIndices(ShardCoding coding)
    : coding_(std::move(coding)), kept_(kept_bytes(index_bytes())) {}

std::uint64_t ShardIndices::index_bytes() const {
  return product(coding_.chunks) * kEntryBytes + (coding_.has_checksum ? 4 : 0);
}

std::uint64_t ShardIndices::max_bytes() const {
  return kept_bytes(index_bytes());
}

std::uint64_t ShardIndices::offset_of(const std::vector<std::int64_t>& chunk) const {
  std::uint64_t index = 0;
  for (const std::size_t axis : coding_.order) {
    index = index * static_cast<std::uint64_t>(coding_.chunks[axis]) +
            static_cast<std::uint64_t>(chunk[axis]);
  }
  return index * kEntryBytes;
}

std::optional<Chunk> ShardIndices::read(const std::filesystem::path& path) const {
  const auto file = open_if_there(path);
  if (!file) return std::nullopt;
  const std::uint64_t size = index_bytes();
  if (file->size() < size) {
    fail_input(
        file->name(), "shard index",
        text("truncated: the file has ", file->size(), " bytes, its index alone needs ", size),
        "get a whole copy of the store");
  }
  Chunk index{.bytes = std::vector<std::byte>(size)};
  file->read_at(coding_.index_at_end ? file->size() - size : 0, index.bytes);
  if (coding_.has_checksum) strip_crc32c(index.bytes, file->name() + ": shard index");
  return index;
}

std::optional<ShardRange> ShardIndices::find(Index3 shard, const std::filesystem::path& path,
                                             const std::vector<std::int64_t>& chunk) const {
  const ChunkCache::Loaded index = kept_.get(number_of(shard), [&] { return read(path); });
  if (!index) return std::nullopt;
  const std::byte* entry = index->bytes.data() + offset_of(chunk);
  const ShardRange range{.offset = load<std::uint64_t>(entry, coding_.byte_order),
                         .bytes = load<std::uint64_t>(entry + 8, coding_.byte_order)};
  if (range.offset == kNone && range.bytes == kNone) return std::nullopt;
  return range;
}

}  // namespace mw::io
