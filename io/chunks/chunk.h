// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A piece of a volume that a store keeps, and reads, as one: how large it may be, how it is read
// from a file of its own, and what stores call its voxels.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/source/file_source.h"
#include "io/json/json_fields.h"
#include "io/volume/decode.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// The voxels of a box as a store has them, unpacked.
struct Chunk {
  std::vector<std::byte> bytes;
  std::shared_ptr<const ByteSource> file;  ///< holds the bytes in place of `bytes`, unless null
  /// The place of the lowest voxel of ChunkSource::load()'s box, in voxels from the first byte.
  std::size_t first = 0;
  /// The distance of neighbours along x, y and z, in voxels.
  Index3 strides;

  [[nodiscard]] std::uint64_t size() const { return file ? file->size() : bytes.size(); }
};

/// What the voxels of a chunk are that a store does not have.
struct ChunkFill {
  std::optional<RawLabel> label = 0;  ///< empty where the fill value is no label
  double number = 0;                  ///< the same value as a number
};

/// Where the bytes of a chunk go.
enum class ChunkPlace {
  kMemory,
  kFile,  ///< an unnamed file, where the codec can unpack to it piece by piece
};

/// Where the chunks of a volume come from.  Thread safety: const members may be called from many
/// threads.
class ChunkSource {
 public:
  virtual ~ChunkSource() = default;
  /// Return the names that errors give the store and a chunk (by its number along x, y and z).
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::string name_of(Index3 chunk) const = 0;

  /// Unpacks a chunk; box has its voxels that are in the volume.  kFile is for chunks too large to
  /// be held in memory; those that the codec cannot stream come in memory nevertheless.
  /// ENSURES: The result is empty when the store has no such chunk, whose voxels then have the fill
  /// value; otherwise its bytes have every voxel of box (the caller checks that again).
  /// ERRORS: mw::Error(kInput) naming the chunk when it is damaged; memory stays bounded by the
  /// size that the chunk must have, whatever its bytes claim.
  [[nodiscard]] virtual std::optional<Chunk> load(Index3 chunk, const Box3& box,
                                                  ChunkPlace place) const = 0;

  /// Returns the most memory that load() takes beside the bytes that it returns in memory.
  [[nodiscard]] virtual std::uint64_t scratch_bytes() const = 0;
  /// Returns the most memory that load() takes with kFile, or nothing where the bytes come in
  /// memory even then.
  [[nodiscard]] virtual std::optional<std::uint64_t> streaming_bytes() const {
    return std::nullopt;
  }
};

/// The most bytes that a chunk may unpack to, whatever a store says.
inline constexpr std::uint64_t kMaxChunkBytes = 2ULL << 30U;

/// Returns the bytes of the voxels of a chunk.
/// ERRORS: mw::Error(kInput) naming file and field when an extent is not positive, or when the
/// bytes are more than kMaxChunkBytes.
[[nodiscard]] std::uint64_t checked_chunk_bytes(std::string_view file, std::string_view field,
                                                Index3 chunk, VoxelType type);

/// Returns a bound on the packed size of this many bytes; lz4-java's framing adds most, a third.
[[nodiscard]] constexpr std::uint64_t max_packed_bytes(std::uint64_t unpacked) {
  constexpr std::uint64_t kHeaders = 64U << 10U;
  return unpacked + unpacked / 2 + kHeaders;
}

/// A volume has few chunks of kLargeChunk bytes or more, so that opening a store may look at each
/// of their files, if they are at most kMaxLooks.
inline constexpr std::uint64_t kLargeChunk = std::uint64_t{16} << 20U;
inline constexpr std::int64_t kMaxLooks = 4096;

/// Returns the bytes of a source from offset on.
/// ERRORS: mw::Error(kInput) when they are more than `max`.
[[nodiscard]] std::vector<std::byte> read_rest(const ByteSource& source, std::uint64_t offset,
                                               std::uint64_t max);

/// Writes the bytes to a file without a name in $TMPDIR or /tmp, and returns that file.
/// ERRORS: mw::Error(kResource) when the disk is full.
[[nodiscard]] std::shared_ptr<const ByteSource> written_to_file(std::span<const std::byte> bytes,
                                                                std::string name);

/// Returns the type called "uint8" .. "uint64", "int8" .. "int64", "float32" or "float64", in small
/// or capital letters; nothing for another text.
[[nodiscard]] std::optional<VoxelType> parse_store_type(std::string_view text);
/// Returns the type that a field tells in these words.
/// ERRORS: those of JsonFields, also for another text.
[[nodiscard]] VoxelType store_type(const JsonFields& fields, std::string_view key);

}  // namespace mw::io
