// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Packs bytes by the libraries' own compressors, and by hand where a framing has none.
#pragma once

#include <blosc.h>
#include <bzlib.h>
#include <lz4.h>
#include <lz4frame.h>
#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

#include "io/codec/checksums.h"
#include "tests/io/test_files.h"

namespace mw::io {

inline std::string zlib_packed(const std::string& plain) {
  uLongf size = compressBound(static_cast<uLong>(plain.size()));
  std::string packed(size, '\0');
  EXPECT_EQ(
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(plain.data()), static_cast<uLong>(plain.size()), 6),
      Z_OK);
  packed.resize(size);
  return packed;
}

/// One frame; a streamed one does not say how much it holds.
inline std::string zstd_packed(const std::string& plain, bool streamed = false) {
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  ZSTD_CCtx* context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, streamed ? 0 : 1);
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
  const std::size_t size =
      ZSTD_compress2(context, packed.data(), packed.size(), plain.data(), plain.size());
  EXPECT_EQ(ZSTD_isError(size), 0U);
  ZSTD_freeCCtx(context);
  packed.resize(size);
  return packed;
}

inline std::string blosc_packed(const std::string& plain, const char* codec, int shuffle,
                                std::size_t type_size) {
  std::string packed(plain.size() + BLOSC_MAX_OVERHEAD, '\0');
  const int size = blosc_compress_ctx(5, shuffle, type_size, plain.size(), plain.data(),
                                      packed.data(), packed.size(), codec, 0, 1);
  EXPECT_GT(size, 0) << codec;
  packed.resize(static_cast<std::size_t>(size));
  return packed;
}

inline std::string lz4_block(const std::string& plain) {
  std::string packed(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(plain.size()))),
                     '\0');
  const int size = LZ4_compress_default(plain.data(), packed.data(), static_cast<int>(plain.size()),
                                        static_cast<int>(packed.size()));
  packed.resize(static_cast<std::size_t>(size));
  return packed;
}

/// numcodecs' framing.
inline std::string lz4_packed(const std::string& plain) {
  return number_bytes(plain.size(), 4, false) + lz4_block(plain);
}

/// XXH32 with seed 0, by the checksum that liblz4 puts at the end of a frame.
inline std::uint32_t xxhash_of_frame(const std::string& plain) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string frame(LZ4F_compressFrameBound(plain.size(), &preferences), '\0');
  frame.resize(
      LZ4F_compressFrame(frame.data(), frame.size(), plain.data(), plain.size(), &preferences));
  std::uint32_t sum = 0;
  std::memcpy(&sum, frame.data() + frame.size() - 4, 4);
  return sum;
}

inline std::string bzip2_packed(const std::string& plain) {
  auto size = static_cast<unsigned>(plain.size() + plain.size() / 100 + 700);
  std::string packed(size, '\0');
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(plain.data()),
                                     static_cast<unsigned>(plain.size()), 9, 0, 0),
            BZ_OK);
  packed.resize(size);
  return packed;
}

inline std::string xz_packed(const std::string& plain, std::uint32_t preset = 6) {
  std::string packed(lzma_stream_buffer_bound(plain.size()), '\0');
  std::size_t size = 0;
  EXPECT_EQ(
      lzma_easy_buffer_encode(preset, LZMA_CHECK_CRC64, nullptr,
                              reinterpret_cast<const std::uint8_t*>(plain.data()), plain.size(),
                              reinterpret_cast<std::uint8_t*>(packed.data()), &size, packed.size()),
      LZMA_OK);
  packed.resize(size);
  return packed;
}

/// A block of lz4-java, by its documentation.
inline std::string java_block(const std::string& plain, bool stored) {
  const std::string body = stored ? plain : lz4_block(plain);
  const std::uint32_t sum = xxhash32(std::as_bytes(std::span(plain)), 0x9747b28c);
  return "LZ4Block" + std::string(1, stored ? '\x16' : '\x26') +
         number_bytes(body.size(), 4, false) + number_bytes(plain.size(), 4, false) +
         number_bytes(sum & 0xfffffffU, 4, false) + body;
}
inline const std::string kJavaEnd = "LZ4Block" + std::string("\x16", 1) + std::string(12, '\0');

inline std::string java_packed(const std::string& plain) {
  std::string packed;
  for (std::size_t at = 0; at < plain.size(); at += 1000) {
    packed += java_block(plain.substr(at, 1000), at % 3000 == 0);
  }
  return packed + kJavaEnd;
}

}  // namespace mw::io
