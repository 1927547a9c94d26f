// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A temporary file without a name: gone when it is closed, however the program ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "io/file/file_descriptor.h"

namespace mw::io {

/// Thread safety: reads and writes of different places may go on at once.
class ScratchFile {
 public:
  /// Creates the file in the folder that TMPDIR names, else /tmp.
  /// purpose: what it holds, for error messages.
  /// ERRORS: mw::Error(kResource) naming folder and reason, here and when the disk is full later.
  explicit ScratchFile(std::string purpose);

  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) const;
  /// REQUIRES: the bytes were written.
  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;

  /// The descriptor, for those who keep the file under another type.
  [[nodiscard]] FileDescriptor release() { return std::move(file_); }

 private:
  std::string purpose_;
  std::string folder_;
  FileDescriptor file_;
};

}  // namespace mw::io
