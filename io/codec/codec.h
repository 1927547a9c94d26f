// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ways in which chunks of stores are packed, how each unpacks, and how files of our own are
// packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/codec/stream.h"

struct ZSTD_CCtx_s;

namespace mw::io {

enum class Codec {
  kNone,  ///< not packed
  kGzip,
  kZlib,
  kZstd,
  kBlosc,
  kLz4,      ///< numcodecs' framing
  kLz4Java,  ///< lz4-java's framing
  kLz4Hdf5,  ///< that of HDF5's registered filter
  kLzf,      ///< h5py's filter
  kBzip2,
  kXz,
};

[[nodiscard]] const char* name(Codec codec);

/// Returns the bytes that `packed` unpacks to.  Errors call them `name`: a file or a chunk.
/// Memory: in the order of `max`, whatever the packed bytes claim; see max_scratch().
/// Thread safety: any.
/// ERRORS: mw::Error(kInput) naming name and codec for damage, truncation and more than `max`
/// bytes; a flipped bit that no checksum of the codec covers gives other bytes, not an error.
[[nodiscard]] std::vector<std::byte> unpack(Codec codec, std::span<const std::byte> packed,
                                            std::size_t max, std::string_view name);

/// Returns the most memory that unpack() takes beside what it returns.
[[nodiscard]] std::uint64_t max_scratch(Codec codec, std::size_t max);

/// Returns the memory that unpack() takes for these bytes, beside them and what it returns; it is
/// no more than max_scratch().
[[nodiscard]] std::uint64_t scratch_of(Codec codec, const ByteSource& packed, std::size_t max);

/// Unpacks more than memory should hold, piece by piece, from a source to a file without a name in
/// $TMPDIR or /tmp.  Returns the source itself where the bytes are not packed.
/// REQUIRES: max_streamed(codec) has a value.
/// ERRORS: also mw::Error(kResource) when the disk is full, and for a frame of Zstandard that looks
/// back farther than kMaxZstdWindow.
[[nodiscard]] std::shared_ptr<const ByteSource> unpack_to_file(
    Codec codec, std::shared_ptr<const ByteSource> packed, std::uint64_t max);

/// Returns the most memory that unpack_to_file() takes, or nothing if the codec only unpacks bytes
/// as a whole.
[[nodiscard]] std::optional<std::uint64_t> max_streamed(Codec codec);

/// How many bytes back a frame of Zstandard may refer; levels up to 20 refer no farther.
inline constexpr std::uint64_t kMaxZstdWindow = std::uint64_t{32} << 20U;

// The functions below call the packed bytes `name` in errors.  They take memory for what comes out,
// at most `max` bytes, and what each says.  Thread safety: any; no state of a library is shared.
// ERRORS: mw::Error(kInput) for damage, truncation and more than `max` bytes.

/// Unpacks Zstandard (RFC 8878) by libzstd: one or more frames, with or without their content size.
/// Memory: 200 KiB.
[[nodiscard]] std::vector<std::byte> unpack_zstd(std::span<const std::byte> packed, std::size_t max,
                                                 std::string_view name);

/// Unpacks Blosc 1 by its library, which works on whole blocks; a block may be all there is.
/// Memory: three times the size of its blocks (blosc_block()) more, and 64 KiB.
[[nodiscard]] std::vector<std::byte> unpack_blosc(std::span<const std::byte> packed,
                                                  std::size_t max, std::string_view name);

/// Returns rows of `row_bytes` packed by Blosc, their bytes shuffled, LZ4 quickly: for data that a
/// run reads again.  REQUIRES: some rows, less than 2 GiB; 1 <= row_bytes <= 255.  ERRORS:
/// std::bad_alloc.
[[nodiscard]] std::vector<std::byte> pack_rows(std::span<const std::byte> rows,
                                               std::size_t row_bytes);

/// Returns the bytes of a block that Blosc's header tells; nothing where there is no whole header.
[[nodiscard]] std::optional<std::uint64_t> blosc_block(std::span<const std::byte> packed);

/// Unpacks LZ4 in numcodecs' framing (Zarr): the unpacked size in 4 bytes, least significant first,
/// and one block.
[[nodiscard]] std::vector<std::byte> unpack_lz4(std::span<const std::byte> packed, std::size_t max,
                                                std::string_view name);

/// Unpacks LZ4 in the framing of lz4-java's LZ4BlockOutputStream (N5): blocks with magic, sizes and
/// a checksum.
[[nodiscard]] std::vector<std::byte> unpack_lz4_java(std::span<const std::byte> packed,
                                                     std::size_t max, std::string_view name);

/// Unpacks LZ4 in the framing of HDF5's registered filter: the unpacked size in 8 bytes and that of
/// a block in 4, most significant first; then blocks, each behind its packed size in 4 bytes; a
/// block that did not shrink is stored.
[[nodiscard]] std::vector<std::byte> unpack_lz4_hdf5(std::span<const std::byte> packed,
                                                     std::size_t max, std::string_view name);

/// The memory that the decoder of xz may take; preset 9, the largest, has a dictionary of 64 MiB.
/// The decoder touches only as much of a dictionary as comes out.
inline constexpr std::uint64_t kMaxXzBytes = std::uint64_t{80} << 20U;

/// Returns a decoder of the streams of gzip (RFC 1952), zlib (RFC 1950), zstd, bzip2 or xz (LZMA2
/// in its container), or null for another codec.  The name must outlive it. Memory: 64 KiB; 4 MiB
/// for bzip2, kMaxXzBytes for xz.
[[nodiscard]] std::unique_ptr<StreamDecoder> stream_decoder(Codec codec, const PackedName& name);

/// Unpacks LZF, h5py's filter: a stream of LibLZF without a header.
[[nodiscard]] std::vector<std::byte> unpack_lzf(std::span<const std::byte> packed, std::size_t max,
                                                std::string_view name);

/// Makes frames of Zstandard (RFC 8878).  Memory: some 700 KiB at most.  Thread safety: none.
class ZstdPacker {
 public:
  /// REQUIRES: level 1 to 3.
  explicit ZstdPacker(int level);
  ~ZstdPacker();
  ZstdPacker(const ZstdPacker&) = delete;
  ZstdPacker& operator=(const ZstdPacker&) = delete;

  /// Appends one frame, which knows its content's size.  ERRORS: std::bad_alloc.
  void append(std::span<const std::byte> bytes, std::vector<std::byte>& out);

 private:
  ZSTD_CCtx_s* context_;
  int level_;
};

}  // namespace mw::io
