// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ways in which chunks of stores are packed.
#include "io/codec/codec.h"

#include <algorithm>

#include "io/codec/stream.h"
#include "io/file/source/byte_source.h"

namespace mw::io {

const char* name(Codec codec) {
  switch (codec) {
    case Codec::kNone:
      return "raw";
    case Codec::kGzip:
      return "gzip";
    case Codec::kZlib:
      return "zlib";
    case Codec::kZstd:
      return "zstd";
    case Codec::kBlosc:
      return "blosc";
    case Codec::kLz4:
    case Codec::kLz4Java:
    case Codec::kLz4Hdf5:
      return "lz4";
    case Codec::kLzf:
      return "lzf";
    case Codec::kBzip2:
      return "bzip2";
    case Codec::kXz:
      break;
  }
  return "xz";
}

std::vector<std::byte> unpack(Codec codec, std::span<const std::byte> packed, std::size_t max,
                              std::string_view name) {
  switch (codec) {
    case Codec::kNone:
      if (packed.size() > max) fail_too_much({"raw", name}, max);
      return {packed.begin(), packed.end()};
    case Codec::kZstd:
      return unpack_zstd(packed, max, name);
    case Codec::kBlosc:
      return unpack_blosc(packed, max, name);
    case Codec::kLz4:
      return unpack_lz4(packed, max, name);
    case Codec::kLz4Java:
      return unpack_lz4_java(packed, max, name);
    case Codec::kLz4Hdf5:
      return unpack_lz4_hdf5(packed, max, name);
    case Codec::kLzf:
      return unpack_lzf(packed, max, name);
    default:
      break;
  }
  const PackedName named{io::name(codec), name};
  return unpack_streams(*stream_decoder(codec, named), packed, max, named);
}

namespace {

constexpr std::uint64_t kMiB = 1 << 20;

std::uint64_t blosc_scratch(std::uint64_t block) {
  return 3 * block + kMiB;
}

}  // namespace

std::uint64_t scratch_of(Codec codec, const ByteSource& packed, std::size_t max) {
  constexpr std::size_t kHeader = 16;
  if (codec != Codec::kBlosc) return max_scratch(codec, max);
  const auto block = blosc_block(read_prefix(packed, kHeader));
  return blosc_scratch(std::min<std::uint64_t>(block.value_or(max), max));
}

std::uint64_t max_scratch(Codec codec, std::size_t max) {
  if (codec == Codec::kBlosc) return blosc_scratch(max);
  if (codec == Codec::kBzip2) return 4 * kMiB;
  if (codec == Codec::kXz) return kMaxXzBytes;
  return kMiB;
}

std::optional<std::uint64_t> max_streamed(Codec codec) {
  constexpr std::uint64_t kPieces = 4 << 20;
  switch (codec) {
    case Codec::kNone:
    case Codec::kGzip:
    case Codec::kZlib:
      return kPieces;
    case Codec::kBzip2:
      return kPieces + max_scratch(codec, 0);
    case Codec::kZstd:
      return kPieces + kMaxZstdWindow;
    case Codec::kXz:
      return kPieces + kMaxXzBytes;
    default:
      return std::nullopt;
  }
}

std::shared_ptr<const ByteSource> unpack_to_file(Codec codec,
                                                 std::shared_ptr<const ByteSource> packed,
                                                 std::uint64_t max) {
  const PackedName named{name(codec), packed->name()};
  if (codec == Codec::kNone) {
    if (packed->size() > max) fail_too_much(named, max);
    return packed;
  }
  const std::unique_ptr<StreamDecoder> decoder = stream_decoder(codec, named);
  return unpack_streams(*decoder, *packed, max, named);
}

}  // namespace mw::io
