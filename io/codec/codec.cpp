// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ways in which chunks of stores are packed.
#include "io/codec/codec.h"

#include "io/codec/blosc.h"
#include "io/codec/bzip2.h"
#include "io/codec/damage.h"
#include "io/codec/deflate.h"
#include "io/codec/lz4.h"
#include "io/codec/xz.h"
#include "io/codec/zstd.h"

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
      return "lz4";
    case Codec::kBzip2:
      return "bzip2";
    case Codec::kXz:
      break;
  }
  return "xz";
}

std::vector<std::byte> unpack(Codec codec, std::span<const std::byte> packed, std::size_t most,
                              std::string_view name) {
  switch (codec) {
    case Codec::kNone:
      if (packed.size() > most) fail_too_much({"raw", name}, most);
      return {packed.begin(), packed.end()};
    case Codec::kGzip:
      return unpack_gzip(packed, most, name);
    case Codec::kZlib:
      return unpack_zlib(packed, most, name);
    case Codec::kZstd:
      return unpack_zstd(packed, most, name);
    case Codec::kBlosc:
      return unpack_blosc(packed, most, name);
    case Codec::kLz4:
      return unpack_lz4(packed, most, name);
    case Codec::kLz4Java:
      return unpack_lz4_java(packed, most, name);
    case Codec::kBzip2:
      return unpack_bzip2(packed, most, name);
    case Codec::kXz:
      break;
  }
  return unpack_xz(packed, most, name);
}

std::uint64_t most_scratch(Codec codec, std::size_t most) {
  constexpr std::uint64_t kMiB = 1 << 20;
  if (codec == Codec::kBlosc) return 3 * std::uint64_t{most} + kMiB;
  if (codec == Codec::kBzip2) return 4 * kMiB;
  if (codec == Codec::kXz) return kMostXzBytes;
  return kMiB;
}

}  // namespace mw::io
