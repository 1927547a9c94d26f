// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What must wait but must not wait in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/file/unlinked_file.h"

namespace mw::io {

/// Bytes are appended, then read by place.  The space is free again when the object goes, or the
/// process, however it ends.
/// ERRORS (all members): mw::Error(kResource) naming the folder when the disk is full; kUsage when
/// the folder cannot be written.  Thread safety: none.
class ScratchFile {
 public:
  /// REQUIRES: an existing folder.
  explicit ScratchFile(const std::filesystem::path& folder) : file_(folder) {}

  void append(std::span<const std::byte> bytes);
  void append(std::string_view text) { append(std::as_bytes(std::span(text))); }
  [[nodiscard]] std::uint64_t size() const { return flushed_ + buffer_.size(); }
  /// REQUIRES: offset + out.size() <= size().
  void read_at(std::uint64_t offset, std::span<std::byte> out);
  /// The file itself, all bytes in it.  REQUIRES: the object is not used afterwards.
  [[nodiscard]] FileDescriptor release();

 private:
  void flush();
  void write(std::span<const std::byte> bytes);

  UnlinkedFile file_;
  std::vector<std::byte> buffer_;
  std::uint64_t flushed_ = 0;
};

}  // namespace mw::io
