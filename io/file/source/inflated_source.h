// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gzip data as a ByteSource that unpacks no more than is asked for, and files that may be gzipped.
#pragma once

#include <zlib.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/file/source/byte_source.h"

namespace mw::io {

enum class DeflateFraming {
  kGzipChain,   ///< gzip members, one after the other
  kZlibOrGzip,  ///< one stream of either kind
  kBare,        ///< one stream without a header and a checksum, as in ZIP archives
};

/// Where deflated bytes are.
struct DeflatedBytes {
  std::uint64_t offset = 0;
  std::uint64_t end = 0;  ///< behind the last byte that may belong to them
  DeflateFraming framing = DeflateFraming::kGzipChain;
  std::string field = "gzip data";  ///< what errors call them
};

/// True if `packed` bytes of deflate can unpack to `bytes`; one byte unpacks to at most 1032.
[[nodiscard]] bool can_inflate_to(std::uint64_t packed, std::uint64_t bytes);

/// Unpacks deflated bytes from front to back.
/// ERRORS (all members): mw::Error(kInput) naming file and place when truncated or corrupt.
/// Memory: 256 KiB and zlib's window.  Thread safety: none.
class Inflater {
 public:
  /// REQUIRES: packed outlives the object; place.offset <= place.end <= packed.size().
  Inflater(const ByteSource& packed, DeflatedBytes deflated);
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Inflates into out; returns the number of bytes, less than out.size() only at the end.
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
/// memory stays bounded and the result can be read by region.  Later bytes are not unpacked.
/// ERRORS: mw::Error(kInput) when there are fewer; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<ByteSource> inflate_to_scratch(const ByteSource& packed,
                                                             const DeflatedBytes& deflated,
                                                             std::uint64_t bytes);

/// Returns three quarters of the bytes that are free now where temporary files go, as others need
/// the disk, too; the largest number where the system does not know.
[[nodiscard]] std::uint64_t room_to_inflate();

/// Unpacks to an unlinked temporary file in $TMPDIR or /tmp, as far as is asked for, so that memory
/// stays bounded and the bytes can be read by region.  size() unpacks everything, which may be
/// much, so that size_within() is better, except for formats that are read from their end.
/// ERRORS (all members): mw::Error(kInput) when the data are corrupt or truncated so far; kResource
/// when they unpack to more than allowed or the disk is full.  Thread safety: that of a ByteSource.
class InflatedSource : public ByteSource {
 public:
  /// Takes the gzip data that begin at offset, of which at most max bytes may be unpacked.
  /// ERRORS: kInput when no gzip data begin there.
  InflatedSource(std::unique_ptr<ByteSource> packed, std::uint64_t offset,
                 std::uint64_t max = room_to_inflate());

  [[nodiscard]] std::uint64_t size() const override;
  [[nodiscard]] std::uint64_t size_within(std::uint64_t max) const override;
  [[nodiscard]] const std::string& name() const override { return packed_->name(); }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override;

 private:
  void unpack_to(std::uint64_t size) const;

  std::unique_ptr<ByteSource> packed_;
  std::uint64_t max_;
  UnlinkedFile file_;
  mutable std::mutex mutex_;                    ///< held while unpacking
  mutable std::unique_ptr<Inflater> inflater_;  ///< null at the end of the data
  mutable std::atomic<std::uint64_t> unpacked_ = 0;
  mutable bool is_too_large_ = false;
};

/// Opens path; a gzip file (by content) is inflated as far as it is read, see InflatedSource.
/// ERRORS: mw::Error(kInput) when missing, a folder, empty, or not a sound gzip file.
[[nodiscard]] std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path);

/// Whether the bytes at offset begin a gzip member.
[[nodiscard]] bool is_gzip(const ByteSource& source, std::uint64_t offset = 0);

}  // namespace mw::io
