// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files in a ZIP archive, by its central directory.
// Format: https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// A file of an archive.
struct ZipMember {
  std::uint64_t header = 0;  ///< where its local header is
  std::uint64_t packed = 0;  ///< bytes in the archive
  std::uint64_t size = 0;    ///< bytes of the file
  std::uint32_t crc = 0;     ///< CRC-32 of the file
  std::uint16_t method = 0;  ///< 0: stored, 8: deflated
  bool is_encrypted = false;
};

/// Names of an archive are names in a map, and open nothing.  The last of several of one name
/// counts.  Archives above 4 GiB or 65,535 files (ZIP64) are read, those in several volumes not.
/// Memory: 48 bytes and the name for each file.  Thread safety: const members from many threads.
class ZipDirectory {
 public:
  /// ERRORS: mw::Error(kInput) naming the archive where its directory is missing or damaged.
  explicit ZipDirectory(const ByteSource& archive);

  /// Returns null for a name that no file has.
  [[nodiscard]] const ZipMember* find(std::string_view name) const;
  /// Whether a file lies below a folder; "" is the archive itself.
  [[nodiscard]] bool has_folder(std::string_view folder) const;
  /// Returns the names of the folders in a folder, sorted.
  [[nodiscard]] std::vector<std::string> folders_in(std::string_view folder) const;

 private:
  struct Row {
    std::uint64_t name;  ///< where it begins in names_
    std::uint32_t length;
    ZipMember member;
  };

  void read_rows(const std::string& directory, std::uint64_t count, const std::string& file);
  void sort_rows();
  [[nodiscard]] std::string_view name_of(const Row& row) const {
    return std::string_view(names_).substr(row.name, row.length);
  }
  /// Returns the first row whose name is not before this one.
  [[nodiscard]] std::vector<Row>::const_iterator lower_bound(std::string_view name) const;

  std::string names_;
  std::vector<Row> rows_;  ///< by name
};

[[nodiscard]] bool has_zip_magic(std::span<const std::byte> head);

}  // namespace mw::io
