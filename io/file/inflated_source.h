// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gzip data as a ByteSource that unpacks no more than is asked for.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "io/file/byte_source.h"
#include "io/file/inflater.h"
#include "io/file/unlinked_file.h"

namespace mw::io {

/// Three quarters of what is free now where temporary files go: others need the disk, too.
/// Bytes; all of them where the system does not know.
[[nodiscard]] std::uint64_t room_to_inflate();

/// The bytes wait in an unlinked temporary file in $TMPDIR or /tmp, so that memory stays bounded
/// and they can be read by region.  What a few bytes unpack to may be much, so ask size_within()
/// rather than size(); formats that are read from their end cannot.
/// ERRORS (all members): mw::Error(kInput) when corrupt or truncated so far; kResource when more
/// would be unpacked than may be, or the disk is full.  Thread safety: that of a ByteSource.
class InflatedSource : public ByteSource {
 public:
  /// The gzip data that begin at offset.  most: bytes that may be unpacked of them.
  /// ERRORS: kInput when there are none.
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
  mutable std::mutex mutex_;                    ///< of those that unpack
  mutable std::unique_ptr<Inflater> inflater_;  ///< null at the end of the data
  mutable std::atomic<std::uint64_t> unpacked_ = 0;
  mutable bool is_too_large_ = false;
};

}  // namespace mw::io
