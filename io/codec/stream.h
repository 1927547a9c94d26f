// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The loop around libraries that unpack piece by piece, and how all codecs word what is wrong with
// packed bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// The codec, and the file (or the chunk in it) that packed bytes are from, as errors name them.
struct PackedName {
  std::string_view codec;
  std::string_view file;
};

/// Throws mw::Error(kInput): "FILE: CODEC: REASON; get a whole copy of the store".
[[noreturn]] void fail_packed(const PackedName& name, std::string_view reason);

/// Throws the error for bytes that unpack to more than `max`.
[[noreturn]] void fail_too_much(const PackedName& name, std::size_t max);

/// Throws mw::Error(kResource) for a library that could not get the memory that it works with.
[[noreturn]] void fail_no_memory(const PackedName& name);

/// A library's decompressor at some place in its stream.
class StreamDecoder {
 public:
  /// What a step did.
  struct Step {
    std::size_t taken = 0;        ///< packed bytes used
    std::size_t given = 0;        ///< bytes unpacked
    bool ended = false;           ///< the stream came to its end
    const char* wrong = nullptr;  ///< why the bytes are damaged
  };

  virtual ~StreamDecoder() = default;
  /// Unpacks from `packed` to `out`, as much as it likes.  A step that does nothing needs more
  /// input.  REQUIRES: out is not empty; both have at most kMaxStreamStep bytes.
  [[nodiscard]] virtual Step step(std::span<const std::byte> packed, std::span<std::byte> out) = 0;
  /// Prepares for another stream, which follows the one that ended.
  virtual void restart() = 0;
};

/// Return a decoder of the format.  ERRORS: those of fail_no_memory().
[[nodiscard]] std::unique_ptr<StreamDecoder> gzip_decoder(const PackedName& name);
[[nodiscard]] std::unique_ptr<StreamDecoder> zlib_decoder(const PackedName& name);
[[nodiscard]] std::unique_ptr<StreamDecoder> bzip2_decoder(const PackedName& name);
[[nodiscard]] std::unique_ptr<StreamDecoder> xz_decoder(const PackedName& name);
[[nodiscard]] std::unique_ptr<StreamDecoder> zstd_decoder(const PackedName& name);

/// The most bytes given to a step, since libraries count bytes in 32 bits.
inline constexpr std::size_t kMaxStreamStep = std::size_t{1} << 30U;

/// Unpacks one or several streams, which zeros may follow.
/// Memory: follows what really comes out, at most max + 1 bytes.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `max` bytes.
[[nodiscard]] std::vector<std::byte> unpack_streams(StreamDecoder& decoder,
                                                    std::span<const std::byte> packed,
                                                    std::size_t max, const PackedName& name);

/// Unpacks from a source to an unlinked file in $TMPDIR or /tmp.  Memory: 3 MiB.
/// ERRORS: also mw::Error(kResource) when the disk is full.
[[nodiscard]] std::shared_ptr<const ByteSource> unpack_streams(StreamDecoder& decoder,
                                                               const ByteSource& packed,
                                                               std::uint64_t max,
                                                               const PackedName& name);

}  // namespace mw::io
