// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ways in which chunks of stores are packed, and how each unpacks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/codec/stream.h"

namespace mw::io {

enum class Codec {
  kNone,  ///< not packed
  kGzip,
  kZlib,
  kZstd,
  kBlosc,
  kLz4,      ///< numcodecs' framing
  kLz4Java,  ///< lz4-java's framing
  kBzip2,
  kXz,
};

[[nodiscard]] const char* name(Codec codec);

/// The bytes that `packed` unpacks to.  name: what errors call them, a file or a chunk in it.
/// Memory: in the order of `max`, whatever the packed bytes claim, see max_scratch().
/// Thread safety: any.
/// ERRORS: mw::Error(kInput) naming name and codec for damage, truncation and more than `max`
/// bytes; flips that the codec has no checksum against give other bytes, not an error.
[[nodiscard]] std::vector<std::byte> unpack(Codec codec, std::span<const std::byte> packed,
                                            std::size_t max, std::string_view name);

/// The most that unpack() takes in memory beside what it returns.
[[nodiscard]] std::uint64_t max_scratch(Codec codec, std::size_t max);

/// What unpack() takes in memory for these bytes beside what it returns, and beside them; no more
/// than max_scratch().
[[nodiscard]] std::uint64_t scratch_of(Codec codec, const ByteSource& packed, std::size_t max);

/// Unpacks from a source to a file without a name in $TMPDIR or /tmp, piece by piece, for more than
/// memory should hold; returns the source itself where the bytes are not packed.
/// REQUIRES: max_streamed(codec) is something.
/// ERRORS: also mw::Error(kResource) when the disk is full, and for a frame of Zstandard that looks
/// back farther than kMaxZstdWindow.
[[nodiscard]] std::shared_ptr<const ByteSource> unpack_to_file(
    Codec codec, std::shared_ptr<const ByteSource> packed, std::uint64_t max);

/// The most that unpack_to_file() takes in memory; nothing: the codec unpacks as a whole only.
[[nodiscard]] std::optional<std::uint64_t> max_streamed(Codec codec);

/// Levels up to 20 of Zstandard look back no farther.
inline constexpr std::uint64_t kMaxZstdWindow = std::uint64_t{32} << 20U;

// In all of them name is what errors call the packed bytes.  Memory: what comes out, at most `max`
// bytes, and what is said.  Thread safety: any; no state of a library is shared.
// ERRORS: mw::Error(kInput) for damage, truncation and more than `max` bytes.

/// gzip (RFC 1952) by zlib: one or several members, behind which zeros may fill up.  Memory: 64
/// KiB.
[[nodiscard]] std::vector<std::byte> unpack_gzip(std::span<const std::byte> packed, std::size_t max,
                                                 std::string_view name);

/// Unpacks zlib's framing (RFC 1950).
[[nodiscard]] std::vector<std::byte> unpack_zlib(std::span<const std::byte> packed, std::size_t max,
                                                 std::string_view name);

/// Zstandard (RFC 8878) by libzstd: one or several frames, with or without their content size.
/// Memory: 200 KiB.
[[nodiscard]] std::vector<std::byte> unpack_zstd(std::span<const std::byte> packed, std::size_t max,
                                                 std::string_view name);

/// Blosc 1 by its library.  Memory: three times the size of its blocks (blosc_block()) more, and
/// 64 KiB: the library works on whole blocks, and a block may be all there is.
[[nodiscard]] std::vector<std::byte> unpack_blosc(std::span<const std::byte> packed,
                                                  std::size_t max, std::string_view name);

/// Bytes of a block as the header of Blosc tells; none: the bytes have no such header.
[[nodiscard]] std::optional<std::uint64_t> blosc_block(std::span<const std::byte> packed);

/// LZ4 in numcodecs' framing (Zarr): the unpacked size in 4 bytes, least significant first, and one
/// block.
[[nodiscard]] std::vector<std::byte> unpack_lz4(std::span<const std::byte> packed, std::size_t max,
                                                std::string_view name);

/// LZ4 in the framing of lz4-java's LZ4BlockOutputStream (N5): blocks with magic, sizes and a
/// checksum.
[[nodiscard]] std::vector<std::byte> unpack_lz4_java(std::span<const std::byte> packed,
                                                     std::size_t max, std::string_view name);

/// LZ4 in the framing of HDF5's registered filter: the unpacked size in 8 bytes and that of a block
/// in 4, most significant first; then blocks, each behind its packed size in 4 bytes; a block that
/// did not shrink is stored.
[[nodiscard]] std::vector<std::byte> unpack_lz4_hdf5(std::span<const std::byte> packed,
                                                     std::size_t max, std::string_view name);

/// bzip2 by libbz2: one or several streams.  Memory: 4 MiB.
[[nodiscard]] std::vector<std::byte> unpack_bzip2(std::span<const std::byte> packed,
                                                  std::size_t max, std::string_view name);

/// What the decoder of xz may take for itself: preset 9, the largest, has a dictionary of 64 MiB.
/// The decoder touches only as much of a dictionary as comes out.
inline constexpr std::uint64_t kMaxXzBytes = std::uint64_t{80} << 20U;

/// .xz (LZMA2 in its container) by liblzma: one or several streams.  Memory: kMaxXzBytes.
[[nodiscard]] std::vector<std::byte> unpack_xz(std::span<const std::byte> packed, std::size_t max,
                                               std::string_view name);

/// What unpacks the streams of gzip, zlib, zstd, bzip2 and xz; null for the other codecs.  The name
/// must outlive it.
[[nodiscard]] std::unique_ptr<StreamDecoder> stream_decoder(Codec codec, const PackedName& name);

/// LZF, h5py's filter: a stream of LibLZF without a header.
[[nodiscard]] std::vector<std::byte> unpack_lzf(std::span<const std::byte> packed, std::size_t max,
                                                std::string_view name);

}  // namespace mw::io
