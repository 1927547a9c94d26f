// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a zip archive holds, by its central directory (PKWARE APPNOTE 6.3), zip64 included.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/file/byte_source.h"

namespace mw::io {

struct ZipMember {
  std::string name;
  bool deflated = false;  ///< else stored as it is
  std::uint32_t crc = 0;  ///< CRC-32 of the unpacked bytes
  std::uint64_t packed_bytes = 0;
  std::uint64_t bytes = 0;   ///< unpacked, as the archive claims
  std::uint64_t header = 0;  ///< where the member's own header begins
};

[[nodiscard]] bool has_zip_magic(std::span<const std::byte> head);

/// Members in the order of the directory.
/// ERRORS: mw::Error(kInput) naming the file when the directory is missing or damaged, when the
/// archive is one of several parts, or for a directory above 64 MiB.
[[nodiscard]] std::vector<ZipMember> read_zip_directory(const ByteSource& zip);

/// Where the packed bytes of a member begin.
/// ENSURES: all of them are in the file.
/// ERRORS: mw::Error(kInput) naming file and member, also when it is encrypted.
[[nodiscard]] std::uint64_t zip_data_offset(const ByteSource& zip, const ZipMember& member);

/// Reads all of `unpacked` once.
/// ERRORS: mw::Error(kInput) when its bytes are not those whose CRC the archive has.
void check_zip_crc(const ByteSource& unpacked, const ZipMember& member);

}  // namespace mw::io
