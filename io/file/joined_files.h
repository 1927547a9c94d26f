// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pieces of many files, read as if they were one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/file/byte_source.h"

namespace mw::io {

/// The bytes [skip, skip + piece_bytes) of each file, one after the other; skip -1: the last bytes.
/// Files are opened for each read, so that there may be any number of them.
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

}  // namespace mw::io
