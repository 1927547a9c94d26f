// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Deflated bytes of a file, inflated from front to back.
#pragma once

#include <zlib.h>

#include <memory>
#include <string>
#include <vector>

#include "io/file/byte_source.h"

namespace mw::io {

enum class DeflateFraming {
  kGzipChain,   ///< gzip members, one after the other
  kZlibOrGzip,  ///< one stream of either kind
};

/// Where deflated bytes are.
struct DeflatedBytes {
  std::uint64_t offset = 0;
  std::uint64_t end = 0;  ///< behind the last byte that may be theirs
  DeflateFraming framing = DeflateFraming::kGzipChain;
  std::string field = "gzip data";  ///< what errors call them
};

/// Whether so many packed bytes can hold so many: deflate cannot pack tighter than 1 to 1032.
[[nodiscard]] bool can_inflate_to(std::uint64_t packed, std::uint64_t bytes);

/// ERRORS of all: mw::Error(kInput) naming file and place when truncated or corrupt.
/// Memory: 256 KiB and zlib's window.  Thread safety: none.
class Inflater {
 public:
  /// REQUIRES: packed outlives the object; place.offset <= place.end <= packed.size().
  Inflater(const ByteSource& packed, DeflatedBytes deflated);
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Inflates into out; the number of bytes, less than out.size() only at the end.
  [[nodiscard]] std::size_t read(std::span<std::byte> out);

 private:
  void step();
  void refill();
  void start_next_member();

  const ByteSource& packed_;
  DeflatedBytes deflated_;
  std::uint64_t next_;
  z_stream stream_{};
  bool done_ = false;
  std::vector<std::byte> buffer_;
};

/// Inflates the first `bytes` bytes into an unlinked temporary file in $TMPDIR or /tmp, so that
/// memory stays bounded and the result can be read by region.  What follows them is not unpacked.
/// ERRORS: mw::Error(kInput) when there are fewer; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<ByteSource> inflate_to_scratch(const ByteSource& packed,
                                                             const DeflatedBytes& deflated,
                                                             std::uint64_t bytes);

}  // namespace mw::io
