// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file, an unlinked temporary one or pieces of many files as a ByteSource, and the paths of files
// that a header names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/file_descriptor.h"
#include "io/file/source/byte_source.h"

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

/// The bytes [skip, skip + piece_bytes) of each file, one after the other; for a skip of -1, the
/// last ones.  Files are opened for each read, so that there may be any number of them.
class JoinedFiles : public ByteSource {
 public:
  /// REQUIRES: skip >= -1; the product of piece_bytes and the number of files fits into 64 bits.
  /// ERRORS: mw::Error(kInput) naming the first file that is missing or too short.
  JoinedFiles(std::vector<std::filesystem::path> files, std::int64_t skip,
              std::uint64_t piece_bytes, std::string name);

  [[nodiscard]] std::uint64_t size() const override { return files_.size() * piece_bytes_; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override;

 private:
  [[nodiscard]] std::uint64_t first_byte(const ByteSource& file) const;

  std::vector<std::filesystem::path> files_;
  std::int64_t skip_;
  std::uint64_t piece_bytes_;
  std::string name_;
};

/// Returns the path that a header, or the metadata of a store, names: in its folder or below, or
/// anywhere if the header is trusted.  Links are followed.
/// ERRORS: mw::Error(kInput) naming the header and its field for names that lead elsewhere
/// (absolute, or with ".."), so that a header from a stranger opens nothing else.
[[nodiscard]] std::filesystem::path named_path(const std::filesystem::path& header,
                                               std::string_view field, std::string_view name,
                                               bool is_trusted);

/// Returns what named_path() does.  ERRORS: also mw::Error(kInput) for a path that is no file.
[[nodiscard]] std::filesystem::path named_beside(const std::filesystem::path& header,
                                                 std::string_view field, std::string_view name,
                                                 bool is_trusted = false);

}  // namespace mw::io
