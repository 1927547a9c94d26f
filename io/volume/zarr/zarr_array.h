// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the metadata of a Zarr array say, of either version of the format, and how the bytes of a
// chunk become voxels by it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/codec/codec.h"
#include "io/file/byte_order.h"
#include "io/store/place.h"
#include "io/volume/label_volume.h"
#include "io/volume/zarr/multiscale.h"

namespace mw::io {

/// The most axes that an array may have.
inline constexpr std::size_t kMaxZarrAxes = 32;

/// A step in which bytes are packed: by a codec, or CRC-32C is put behind them.
struct PackStep {
  Codec codec = Codec::kNone;
  bool is_crc32c = false;
};

/// How the voxels of a chunk become bytes.  All vectors of axes have one entry an axis of the
/// array.
struct ChunkCoding {
  std::vector<std::int64_t> shape;
  std::vector<std::size_t> order;  ///< axes of the array, from the slowest to the fastest
  ByteOrder byte_order = ByteOrder::kLittle;
  std::vector<PackStep> steps;  ///< in the order of writing
};

/// How a shard holds its chunks: one after the other, and an index of 16 bytes a chunk.
struct ShardCoding {
  std::vector<std::int64_t> chunks;  ///< how many along each axis
  std::vector<std::size_t> order;    ///< axes in which the index counts, from the slowest
  bool index_at_end = true;
  bool has_checksum = false;  ///< CRC-32C behind the index
  ByteOrder byte_order = ByteOrder::kLittle;
};

/// Names of the files: prefix, then the numbers along the axes with the separator between two.
struct ChunkKeys {
  std::string prefix;
  char separator = '.';
};

struct ZarrArray {
  std::vector<std::int64_t> shape;
  VoxelType type = VoxelType::kU8;  ///< booleans are kU8
  std::optional<RawLabel> fill;     ///< of chunks that are not there; empty: it is no label
  ChunkKeys keys;
  ChunkCoding chunk;                    ///< what is read at once: within shards, their chunks
  std::optional<ShardCoding> shard;     ///< what a file holds, if not one chunk
  std::vector<std::string> axis_names;  ///< by `dimension_names`; empty: none
};

/// Bytes of the voxels of a chunk.  REQUIRES: checked (check_chunk).
[[nodiscard]] std::uint64_t chunk_bytes(const ZarrArray& array);

/// ERRORS: mw::Error(kInput) naming file and field when there are more than kMaxZarrAxes.
void check_axes(std::string_view file, std::string_view field, std::size_t axes);

/// ERRORS: mw::Error(kInput) naming file and field unless there is one positive extent an axis.
void check_grid(std::string_view file, std::string_view field,
                const std::vector<std::int64_t>& extents, std::size_t axes);

/// ERRORS: those of check_grid(), and mw::Error(kInput) for more than kMaxChunkBytes of voxels.
void check_chunk(std::string_view file, std::string_view field,
                 const std::vector<std::int64_t>& chunk, std::size_t axes, VoxelType type);

/// Unpacks a chunk.  name: what errors call it.
/// ENSURES: the bytes are as many as the chunk's voxels need.
/// ERRORS: mw::Error(kInput) naming `name` when it is damaged.
[[nodiscard]] Chunk unpack_chunk(const ZarrArray& array, const AxisMap& axes,
                                 std::vector<std::byte> packed, std::string_view name);

/// Unpacks to a file without a name, piece by piece.  REQUIRES: unpack_streaming() is something.
[[nodiscard]] Chunk unpack_chunk_to_file(const ZarrArray& array, const AxisMap& axes,
                                         std::shared_ptr<const ByteSource> packed);

/// The bytes in front of the CRC-32C that ends them.
/// ERRORS: mw::Error(kInput) naming `name` when it is another.
void strip_crc32c(std::vector<std::byte>& bytes, std::string_view name);

/// The most that a packed chunk may have.
[[nodiscard]] std::uint64_t max_packed(const ZarrArray& array);
/// The most that reading and unpacking a chunk takes beside its voxels that are in the volume: axes
/// of one entry may have chunks of more.
[[nodiscard]] std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes);
/// What it takes for this chunk, as its size and its header tell.
[[nodiscard]] std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes,
                                           const ByteSource& packed);
/// The most that unpack_chunk_to_file() takes; nothing when a codec cannot.
[[nodiscard]] std::optional<std::uint64_t> unpack_streaming(const ZarrArray& array);

/// A missing file, and a chunk that a shard does not have, are fill values: an error when those are
/// no labels.  An index of a shard is read once and kept with the last used others.
/// REQUIRES: the array is checked, and axes are its.
[[nodiscard]] std::unique_ptr<ChunkSource> zarr_chunks(const Place& folder, const ZarrArray& array,
                                                       const AxisMap& axes);

}  // namespace mw::io
