// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A Zarr array: what its metadata say, in both versions of the format, and its chunks.
// Format: https://zarr-specs.readthedocs.io/en/latest/v2/v2.0.html
// Format: https://zarr-specs.readthedocs.io/en/latest/v3/core/index.html
// Format: https://zarr-specs.readthedocs.io/en/latest/v3/codecs/sharding-indexed/index.html
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
#include "io/json/json.h"
#include "io/json/json_fields.h"
#include "io/store/place.h"
#include "io/volume/label_volume.h"
#include "io/volume/zarr/multiscale.h"

namespace mw::io {

/// The most axes that an array may have.
inline constexpr std::size_t kMaxZarrAxes = 32;

/// A step of packing: a codec packs the bytes, or their CRC-32C is put behind them.
struct PackStep {
  Codec codec = Codec::kNone;
  bool is_crc32c = false;
};

/// How the voxels of a chunk become bytes.  shape and order have one entry an axis of the array.
struct ChunkCoding {
  std::vector<std::int64_t> shape;
  std::vector<std::size_t> order;  ///< axes of the array, from the slowest to the fastest
  ByteOrder byte_order = ByteOrder::kLittle;
  std::vector<PackStep> steps;  ///< in the order of writing
};

/// How a shard holds its chunks, which an index of 16 bytes a chunk finds.
struct ShardCoding {
  std::vector<std::int64_t> chunks;  ///< how many along each axis
  std::vector<std::size_t> order;    ///< axes in which the index counts, from the slowest
  bool index_at_end = true;
  bool has_checksum = false;  ///< CRC-32C behind the index
  ByteOrder byte_order = ByteOrder::kLittle;
};

/// The names of files: a prefix, then the numbers along the axes with separators between them.
struct ChunkKeys {
  std::string prefix;
  char separator = '.';
};

struct ZarrArray {
  std::vector<std::int64_t> shape;
  VoxelType type = VoxelType::kU8;  ///< booleans are kU8
  ChunkFill fill;                   ///< for chunks that are not there
  ChunkKeys keys;
  ChunkCoding chunk;                    ///< what is read at once: within shards, their chunks
  std::optional<ShardCoding> shard;     ///< what a file holds, if not one chunk
  std::vector<std::string> axis_names;  ///< by `dimension_names`; empty: none
};

/// Returns the bytes of the voxels of a chunk.  REQUIRES: the shape was checked (check_chunk).
[[nodiscard]] std::uint64_t chunk_bytes(const ZarrArray& array);

/// ERRORS: mw::Error(kInput) naming file and field when there are more than kMaxZarrAxes.
void check_axes(std::string_view file, std::string_view field, std::size_t axes);

/// ERRORS: mw::Error(kInput) naming file and field unless there is one positive extent an axis.
void check_grid(std::string_view file, std::string_view field,
                const std::vector<std::int64_t>& extents, std::size_t axes);

/// ERRORS: those of check_grid(), and mw::Error(kInput) for more than kMaxChunkBytes of voxels.
void check_chunk(std::string_view file, std::string_view field,
                 const std::vector<std::int64_t>& chunk, std::size_t axes, VoxelType type);

/// Unpacks a chunk, which errors call `name`.
/// ENSURES: the bytes are as many as the chunk's voxels need.
/// ERRORS: mw::Error(kInput) naming `name` when it is damaged.
[[nodiscard]] Chunk unpack_chunk(const ZarrArray& array, const AxisMap& axes,
                                 std::vector<std::byte> packed, std::string_view name);

/// Unpacks to a file without a name, piece by piece.  REQUIRES: unpack_streaming() has a value.
[[nodiscard]] Chunk unpack_chunk_to_file(const ZarrArray& array, const AxisMap& axes,
                                         std::shared_ptr<const ByteSource> packed);

/// Takes off the CRC-32C that ends the bytes.
/// ERRORS: mw::Error(kInput) naming `name` when it is not that of the bytes in front of it.
void strip_crc32c(std::vector<std::byte>& bytes, std::string_view name);

/// Returns the most bytes that a packed chunk may have.
[[nodiscard]] std::uint64_t max_packed(const ZarrArray& array);
/// Returns the most that reading and unpacking a chunk takes beside its voxels that are in the
/// volume.  Along axes that are left out, chunks may have more entries than the array.
[[nodiscard]] std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes);
/// Returns what it takes for this chunk, as its size and its header tell.
[[nodiscard]] std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes,
                                           const ByteSource& packed);
/// Returns the most that unpack_chunk_to_file() takes; nothing when a codec cannot do it.
[[nodiscard]] std::optional<std::uint64_t> unpack_streaming(const ZarrArray& array);

/// A missing file, and a chunk that a shard does not have, are fill values.  The index of a shard
/// is read once and kept, with those of others used last. REQUIRES: the array is checked, and axes
/// are its.
[[nodiscard]] std::unique_ptr<ChunkSource> zarr_chunks(const Place& folder, const ZarrArray& array,
                                                       const AxisMap& axes);

/// Reads `fill_value` of either version: null is 0; true and false are 1 and 0; numbers are exact
/// up to 64 bits; floats may be "NaN", "Infinity", "-Infinity" or the hexadecimal of their bits.
/// ENSURES: there is no label for a float that is no whole number.
/// ERRORS: mw::Error(kInput) naming file and field for what the type cannot hold.
[[nodiscard]] ChunkFill parse_fill_value(const Json& value, VoxelType type, std::string_view file);

// The two functions below: errors name `file`.  ERRORS: mw::Error(kInput) naming file and field for
// what is missing, wrong or not read here.

/// Reads a .zarray (Zarr specification, version 2), but no filters, structured types or compressors
/// beyond those of Codec.
[[nodiscard]] ZarrArray parse_zarr_v2(const Json& document, const std::string& file);

/// Reads a zarr.json (Zarr core specification, version 3.0) with the codecs bytes, transpose, gzip,
/// zstd, blosc, crc32c and sharding_indexed, but no extensions that must be understood.
[[nodiscard]] ZarrArray parse_zarr_v3(const Json& document, const std::string& file);

/// An extension, written as "NAME" or {"name": "NAME", "configuration": {...}}.
struct Extension {
  std::string name;
  Json configuration;  ///< an object, empty when there is none
  std::string where;   ///< what errors call the configuration

  [[nodiscard]] JsonFields fields(const std::string& file) const {
    return {configuration, file, where};
  }
};

/// Reads an extension.  ERRORS: mw::Error(kInput) naming file and `where` for another form.
[[nodiscard]] Extension parse_extension(const Json& value, const std::string& file,
                                        const std::string& where);

/// Reads `codecs` into array.chunk and array.shard.
/// REQUIRES: type and shape of the array are set, and array.chunk.shape is the one of the grid:
/// with sharding it becomes that of the shards' chunks.
/// ERRORS: mw::Error(kInput) naming file and codec for an unknown one, a wrong order, and sharding
/// within shards or below further codecs.
void parse_codecs(const Json& codecs, const std::string& file, ZarrArray& array);

}  // namespace mw::io
