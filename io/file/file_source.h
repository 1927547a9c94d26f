// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file, or an unlinked temporary one, as a ByteSource.
#pragma once

#include <filesystem>

#include "io/file/byte_source.h"
#include "io/file/file_descriptor.h"

namespace mw::io {

class FileSource : public ByteSource {
 public:
  /// ERRORS: mw::Error(kInput) when path is missing, a folder, no regular file, or unreadable.
  explicit FileSource(const std::filesystem::path& path);
  /// Takes over an open file of `size` bytes.
  FileSource(FileDescriptor file, std::uint64_t size, std::string name)
      : file_(std::move(file)), size_(size), name_(std::move(name)) {}

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override;

 private:
  FileDescriptor file_;
  std::uint64_t size_ = 0;
  std::string name_;
};

}  // namespace mw::io
