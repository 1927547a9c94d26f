// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A temporary file without a name: gone when it is closed, however the program ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "io/file/file_descriptor.h"

namespace mw::io {

/// Where a file cannot be made without a name, its name begins so in the instant before it has
/// none; a kill then leaves one behind.
inline constexpr const char* kScratchPrefix = ".mwmesh-scratch-";

/// Bytes by place.
/// ERRORS (all members): mw::Error(kResource) naming the folder when the disk is full; kUsage when
/// the folder cannot be written.  Thread safety: different places may be used at once.
class UnlinkedFile {
 public:
  /// REQUIRES: an existing folder.
  explicit UnlinkedFile(const std::filesystem::path& folder);

  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) const;
  /// REQUIRES: the bytes were written.
  void read_at(std::uint64_t offset, std::span<std::byte> out) const;
  /// The file itself.  REQUIRES: the object is not used afterwards.
  [[nodiscard]] FileDescriptor release() { return std::move(file_); }

 private:
  std::string folder_;
  FileDescriptor file_;
};

/// $TMPDIR, or /tmp when it is not set.
[[nodiscard]] std::filesystem::path scratch_folder();

}  // namespace mw::io
