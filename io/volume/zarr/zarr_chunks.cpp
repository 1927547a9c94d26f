// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds chunks of a Zarr array in files and in shards, and reads them.
#include <algorithm>
#include <memory>
#include <optional>

#include "io/chunks/chunked_volume.h"
#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/zarr/multiscale.h"
#include "io/volume/zarr/zarr_array.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kEntryBytes = 16;  // offset and length
constexpr std::uint64_t kNone = UINT64_MAX;

/// Returns the bytes of indices that are kept: enough for 32 shards of 4096 chunks, and for one of
/// any number of chunks with what keeping it costs.
std::uint64_t kept_bytes(std::uint64_t index) {
  return std::max<std::uint64_t>(2U << 20U, index + 1024);
}

/// Returns a number for a shard; there are at most kMaxAxisVoxels of them along an axis.
std::uint64_t number_of(Index3 shard) {
  constexpr Index3 kAll{kMaxAxisVoxels, kMaxAxisVoxels, kMaxAxisVoxels};
  return static_cast<std::uint64_t>(Box3{{0, 0, 0}, kAll}.offset(shard));
}

/// Where a chunk is in a shard's file.  It is not compared to the size of the file.
struct ShardRange {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::uint64_t file_bytes = 0;
};

/// Reads the indices of shards, and keeps those used last, each with the size of its file behind
/// it.  Thread safety: any.
class ShardIndices {
 public:
  explicit ShardIndices(ShardCoding coding);

  /// Returns where a chunk is.  shard is the shard's number along x, y and z, path is its file, and
  /// chunk is the number in the shard along each axis of the array.
  /// ENSURES: empty when there is no such file, or no such chunk in it.
  /// ERRORS: mw::Error(kInput) naming the file when its index is damaged.
  [[nodiscard]] std::optional<ShardRange> find(Index3 shard, const Place& path,
                                               const std::vector<std::int64_t>& chunk) const;
  /// Returns the most bytes that are kept.
  [[nodiscard]] std::uint64_t max_bytes() const;

 private:
  [[nodiscard]] std::uint64_t index_bytes() const;  ///< with the checksum
  [[nodiscard]] std::optional<Chunk> read(const Place& path) const;
  [[nodiscard]] std::uint64_t offset_of(const std::vector<std::int64_t>& chunk) const;

  ShardCoding coding_;
  mutable ChunkCache kept_;
};

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

std::optional<Chunk> ShardIndices::read(const Place& path) const {
  const auto file = path.open_parts_if_there();
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
  index.bytes.resize(index.bytes.size() + sizeof(std::uint64_t));
  store_little(file->size(), index.bytes.data() + index.bytes.size() - sizeof(std::uint64_t));
  return index;
}

std::optional<ShardRange> ShardIndices::find(Index3 shard, const Place& path,
                                             const std::vector<std::int64_t>& chunk) const {
  const ChunkCache::Loaded index = kept_.get(number_of(shard), [&] { return read(path); });
  if (!index) return std::nullopt;
  const std::byte* entry = index->bytes.data() + offset_of(chunk);
  const ShardRange range{
      .offset = load<std::uint64_t>(entry, coding_.byte_order),
      .bytes = load<std::uint64_t>(entry + 8, coding_.byte_order),
      .file_bytes = load<std::uint64_t>(
          index->bytes.data() + index->bytes.size() - sizeof(std::uint64_t), ByteOrder::kLittle)};
  if (range.offset == kNone && range.bytes == kNone) return std::nullopt;
  return range;
}

/// What files of chunks and files of shards share.
class ZarrChunks : public ChunkSource {
 public:
  ZarrChunks(Place folder, ZarrArray array, AxisMap axes)
      : folder_(std::move(folder)), array_(std::move(array)), axes_(axes) {}

  [[nodiscard]] std::string name() const override { return folder_.string(); }
  [[nodiscard]] std::optional<std::uint64_t> streaming_bytes() const override {
    return unpack_streaming(array_);
  }

 protected:
  [[nodiscard]] bool is_streamed(ChunkPlace place) const {
    return place == ChunkPlace::kFile && streaming_bytes();
  }
  [[nodiscard]] const ZarrArray& array() const { return array_; }
  [[nodiscard]] const AxisMap& axes() const { return axes_; }
  [[nodiscard]] const Place& folder() const { return folder_; }

  /// Returns the file of that number along x, y and z.
  [[nodiscard]] Place path_of(Index3 number) const {
    std::string key;
    for (const std::int64_t along : axes_.spread(number, array_.shape.size())) {
      if (!key.empty()) key += array_.keys.separator;
      key += std::to_string(along);
    }
    return folder_ / (array_.keys.prefix + key);
  }

 private:
  Place folder_;
  ZarrArray array_;
  AxisMap axes_;
};

class ChunkFiles : public ZarrChunks {
 public:
  ChunkFiles(const Place& folder, const ZarrArray& array, const AxisMap& axes)
      : ZarrChunks(folder, array, axes), scratch_(found_scratch()) {}

  [[nodiscard]] std::string name_of(Index3 chunk) const override { return path_of(chunk).string(); }
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& /*box*/,
                                          ChunkPlace place) const override {
    std::shared_ptr<const ByteSource> file = path_of(chunk).open_if_there(max_packed(array()));
    if (!file) return std::nullopt;
    if (is_streamed(place)) return unpack_chunk_to_file(array(), axes(), std::move(file));
    return unpack_chunk(array(), axes(), read_rest(*file, 0, max_packed(array())), file->name());
  }
  [[nodiscard]] std::optional<std::uint64_t> streaming_bytes() const override {
    const auto chunk = ZarrChunks::streaming_bytes();
    return chunk ? std::optional(*chunk + held_bytes()) : std::nullopt;
  }
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return scratch_ + held_bytes(); }

 private:
  [[nodiscard]] std::uint64_t held_bytes() const {
    return folder().held_bytes(max_packed(array()));
  }
  /// Returns what the chunks that are there take, where they are large; else what any may take.
  [[nodiscard]] std::uint64_t found_scratch() const {
    const std::uint64_t most = unpack_scratch(array(), axes());
    const Index3 chunk = axes().pick(array().chunk.shape, 1);
    const Box3 grid = cells_of({{0, 0, 0}, axes().pick(array().shape, 1)}, chunk);
    if (chunk_bytes(array()) < kLargeChunk || grid.voxels() > kMaxLooks) return most;
    if (!folder().is_near()) return most;
    std::uint64_t found = 0;
    for_each_index(grid, [&](Index3 number) {
      const auto file = path_of(number).open_if_there(max_packed(array()));
      if (file) found = std::max(found, unpack_scratch(array(), axes(), *file));
    });
    return std::min(found, most);
  }

  std::uint64_t scratch_;
};

class ShardFiles : public ZarrChunks {
 public:
  ShardFiles(const Place& folder, const ZarrArray& array, const AxisMap& axes)
      : ZarrChunks(folder, array, axes),
        chunks_(axes.pick(array.shard->chunks, 1)),
        indices_(*array.shard) {}

  [[nodiscard]] std::string name_of(Index3 chunk) const override {
    const Index3 inside = chunk_in_shard(chunk);
    return text(path_of(shard_of(chunk)).string(), ": chunk (", inside.x, ", ", inside.y, ", ",
                inside.z, ") of the shard");
  }
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& /*box*/,
                                          ChunkPlace place) const override {
    const Index3 shard = shard_of(chunk);
    const Place path = path_of(shard);
    const auto inside = axes().spread(chunk_in_shard(chunk), array().shape.size());
    const auto range = indices_.find(shard, path, inside);
    if (!range) return std::nullopt;
    const auto packed = part_of(path, *range, chunk);
    if (is_streamed(place)) return unpack_chunk_to_file(array(), axes(), packed);
    return unpack_chunk(array(), axes(), read_rest(*packed, 0, max_packed(array())),
                        packed->name());
  }
  [[nodiscard]] std::optional<std::uint64_t> streaming_bytes() const override {
    const auto chunk = ZarrChunks::streaming_bytes();
    return chunk ? std::optional(*chunk + indices_.max_bytes()) : std::nullopt;
  }
  [[nodiscard]] std::uint64_t scratch_bytes() const override {
    return unpack_scratch(array(), axes()) + indices_.max_bytes();
  }

 private:
  [[nodiscard]] Index3 shard_of(Index3 chunk) const {
    return {chunk.x / chunks_.x, chunk.y / chunks_.y, chunk.z / chunks_.z};
  }
  [[nodiscard]] Index3 chunk_in_shard(Index3 chunk) const {
    return {chunk.x % chunks_.x, chunk.y % chunks_.y, chunk.z % chunks_.z};
  }
  [[nodiscard]] std::shared_ptr<const ByteSource> part_of(const Place& path,
                                                          const ShardRange& range,
                                                          Index3 chunk) const {
    const bool is_inside =
        range.offset <= range.file_bytes && range.bytes <= range.file_bytes - range.offset;
    if (!is_inside || range.bytes > max_packed(array())) {
      fail_input(name_of(chunk), "shard index",
                 text("places it at ", range.offset, " with ", range.bytes, " bytes; the file has ",
                      range.file_bytes, " and a chunk at most ", max_packed(array())),
                 "get a whole copy of the store");
    }
    return path.open_part(range.offset, range.bytes, name_of(chunk));
  }

  Index3 chunks_;  ///< how many a shard has
  ShardIndices indices_;
};

}  // namespace

std::unique_ptr<ChunkSource> zarr_chunks(const Place& folder, const ZarrArray& array,
                                         const AxisMap& axes) {
  if (array.shard) return std::make_unique<ShardFiles>(folder, array, axes);
  return std::make_unique<ChunkFiles>(folder, array, axes);
}

}  // namespace mw::io
