// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads chunks out of a folder of shards.
#include "io/volume/precomputed/sharding.h"

#include <array>
#include <cstring>

#include "io/chunks/chunk.h"
#include "io/codec/codec.h"
#include "io/file/byte_order.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

/// The bytes of indices that are kept, enough for those around a window: 512 chunks take 12 KiB.
constexpr std::uint64_t kKeptIndexBytes = 4ULL << 20U;

/// Chunks of a minishard come in any order, as the differences between them may wrap.
std::optional<ShardEntry> entry_of(const Chunk& index, std::uint64_t chunk) {
  ShardEntry entry;
  for (std::size_t at = 0; at < index.bytes.size(); at += sizeof entry) {
    std::memcpy(&entry, index.bytes.data() + at, sizeof entry);
    if (entry.chunk == chunk) return entry;
  }
  return std::nullopt;
}

/// Before 2019 a shard was two files, <shard>.index and <shard>.data.
void refuse_old_shard(const Place& folder, std::string shard) {
  shard.replace(shard.rfind(".shard"), shard.npos, ".index");
  const Place index = folder / shard;
  if (!index.is_file()) return;
  fail_input(index.string(), {}, "the shard is of an old form, an index and data apart",
             "join the two to a file with .shard instead of .index");
}

std::vector<std::byte> read_part(const ByteSource& file, std::uint64_t offset, std::uint64_t size) {
  std::vector<std::byte> bytes(size);
  file.read_at(offset, bytes);
  return bytes;
}

}  // namespace

ShardFolder::ShardFolder(Place folder, const Sharding& sharding, Index3 grid)
    : folder_(std::move(folder)),
      sharding_(sharding),
      max_index_bytes_(sizeof(ShardEntry) * max_in_minishard(sharding, grid)),
      indices_(kKeptIndexBytes) {}

Place ShardFolder::path_of(std::uint64_t chunk) const {
  return folder_ / shard_file_name(sharding_, position_of(sharding_, chunk).shard);
}

std::shared_ptr<const ByteSource> ShardFolder::find(std::uint64_t chunk, std::string name,
                                                    std::uint64_t max) const {
  const ShardPosition position = position_of(sharding_, chunk);
  const Place path = path_of(chunk);
  const std::uint64_t number =
      position.shard << static_cast<unsigned>(sharding_.minishard_bits) | position.minishard;
  const auto index = indices_.get(number, [&] { return load_index(path, position.minishard); });
  if (!index) return nullptr;
  const auto entry = entry_of(*index, chunk);
  if (!entry) return nullptr;
  if (entry->size > max) {
    fail_input(path.string(), text("chunk ", chunk),
               text("the chunk has ", entry->size, " bytes, and its voxels need at most ", max),
               "get a whole copy of the store");
  }
  // The index was compared with the file's size when it was read.
  return path.open_part(shard_index_bytes(sharding_) + entry->offset, entry->size, std::move(name));
}

std::optional<Chunk> ShardFolder::load_index(const Place& path, std::uint64_t minishard) const {
  const auto file = path.open_parts_if_there();
  if (!file) {
    refuse_old_shard(folder_, path.last_part());
    return std::nullopt;
  }
  const std::uint64_t start = shard_index_bytes(sharding_);
  std::array<std::byte, 16> entry{};
  file->read_at(entry.size() * minishard, entry);
  const auto begin = load<std::uint64_t>(entry.data(), ByteOrder::kLittle);
  const auto end = load<std::uint64_t>(entry.data() + 8, ByteOrder::kLittle);
  if (begin == end) return std::nullopt;
  const std::string name = text(path.string(), ": minishard ", minishard);
  const std::uint64_t data_bytes = file->size() > start ? file->size() - start : 0;
  if (begin > end || end > data_bytes) {
    fail_input(name, "shard index",
               text("bytes ", begin, " to ", end, " are not in the ", data_bytes, " of the shard"),
               "get a whole copy of the store");
  }
  const std::uint64_t max =
      sharding_.packed_index ? max_packed_bytes(max_index_bytes_) : max_index_bytes_;
  if (end - begin > max) {
    fail_input(name, "shard index",
               text("an index of ", end - begin, " bytes, and all its chunks need at most ", max),
               "get a whole copy of the store");
  }
  std::vector<std::byte> bytes = read_part(*file, start + begin, end - begin);
  if (sharding_.packed_index) bytes = unpack(Codec::kGzip, bytes, max_index_bytes_, name);
  const auto entries = parse_minishard_index(bytes, data_bytes, name);
  const auto raw = std::as_bytes(std::span(entries));
  return Chunk{.bytes = {raw.begin(), raw.end()}};
}

std::uint64_t ShardFolder::scratch_bytes() const {
  return kKeptIndexBytes + max_packed_bytes(max_index_bytes_) + 3 * max_index_bytes_ +
         max_scratch(Codec::kGzip, max_index_bytes_);
}

}  // namespace mw::io
