// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a zip archive holds.
#include "io/volume/npz/zip_directory.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::uint32_t kLocalHeader = 0x04034b50;
constexpr std::uint32_t kDirectoryEntry = 0x02014b50;
constexpr std::uint32_t kEnd = 0x06054b50;
constexpr std::uint32_t kEnd64 = 0x06064b50;
constexpr std::uint32_t kEnd64Locator = 0x07064b50;
constexpr std::size_t kLocalBytes = 30;
constexpr std::size_t kEntryBytes = 46;
constexpr std::size_t kEndBytes = 22;
constexpr std::size_t kEnd64Bytes = 56;
constexpr std::size_t kLocatorBytes = 20;
constexpr std::size_t kMaxComment = 65535;
constexpr std::uint64_t kMaxDirectoryBytes = 64 << 20;
constexpr std::uint32_t kIn64 = 0xffffffff;  ///< the number is in the zip64 field

[[noreturn]] void fail(const ByteSource& zip, std::string_view reason) {
  fail_input(zip.name(), "zip directory", reason, "the file is truncated or damaged");
}

template <class T>
T little(std::span<const std::byte> bytes, std::size_t at) {
  return load<T>(bytes.data() + at, ByteOrder::kLittle);
}

/// Where the directory is.
struct Directory {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

std::vector<std::byte> read_bytes(const ByteSource& zip, std::uint64_t offset, std::size_t count) {
  if (offset > zip.size() || count > zip.size() - offset) fail(zip, "it leads out of the file");
  std::vector<std::byte> bytes(count);
  zip.read_at(offset, bytes);
  return bytes;
}

/// The end record is the last thing in the file but a comment.
std::uint64_t find_end(const ByteSource& zip) {
  const auto length =
      static_cast<std::size_t>(std::min<std::uint64_t>(zip.size(), kEndBytes + kMaxComment));
  const auto tail = read_bytes(zip, zip.size() - length, length);
  for (std::size_t left = kEndBytes; left <= length; ++left) {
    const std::size_t at = length - left;
    if (little<std::uint32_t>(tail, at) == kEnd) return zip.size() - left;
  }
  fail(zip, "its end record was not found");
}

/// The 64-bit end record, which a locator in front of the end record leads to.
Directory find_directory64(const ByteSource& zip, std::uint64_t end) {
  if (end < kLocatorBytes) fail(zip, "its zip64 locator is missing");
  const auto locator = read_bytes(zip, end - kLocatorBytes, kLocatorBytes);
  if (little<std::uint32_t>(locator, 0) != kEnd64Locator) {
    fail(zip, "its zip64 locator is missing");
  }
  const auto record = read_bytes(zip, little<std::uint64_t>(locator, 8), kEnd64Bytes);
  if (little<std::uint32_t>(record, 0) != kEnd64) fail(zip, "its zip64 end record is missing");
  return {.offset = little<std::uint64_t>(record, 48), .bytes = little<std::uint64_t>(record, 40)};
}

Directory find_directory(const ByteSource& zip) {
  const std::uint64_t end = find_end(zip);
  const auto record = read_bytes(zip, end, kEndBytes);
  if (little<std::uint16_t>(record, 4) != little<std::uint16_t>(record, 6)) {
    fail(zip, "the archive is one of several parts");
  }
  const auto entries = little<std::uint16_t>(record, 10);
  const Directory found{.offset = little<std::uint32_t>(record, 16),
                        .bytes = little<std::uint32_t>(record, 12)};
  const bool is64 = entries == 0xffff || found.offset == kIn64 || found.bytes == kIn64;
  return is64 ? find_directory64(zip, end) : found;
}

/// Replaces the numbers that did not fit into 32 bits by those of the entry's zip64 field.
void take_zip64(const ByteSource& zip, std::span<const std::byte> extra, ZipMember& member) {
  constexpr std::uint16_t kZip64Field = 1;
  while (extra.size() >= 4) {
    const std::size_t length = little<std::uint16_t>(extra, 2);
    if (length > extra.size() - 4) fail(zip, "a field leads out of its entry");
    std::span<const std::byte> field = extra.subspan(4, length);
    if (little<std::uint16_t>(extra, 0) == kZip64Field) {
      for (std::uint64_t* number : {&member.bytes, &member.packed_bytes, &member.header}) {
        if (*number != kIn64 || field.size() < 8) continue;
        *number = little<std::uint64_t>(field, 0);
        field = field.subspan(8);
      }
    }
    extra = extra.subspan(4 + length);
  }
}

/// The entry at the front of rest, which is taken off.
ZipMember take_entry(const ByteSource& zip, std::span<const std::byte>& rest) {
  if (rest.size() < kEntryBytes || little<std::uint32_t>(rest, 0) != kDirectoryEntry) {
    fail(zip, "an entry is damaged");
  }
  const std::size_t name = little<std::uint16_t>(rest, 28);
  const std::size_t extra = little<std::uint16_t>(rest, 30);
  const std::size_t comment = little<std::uint16_t>(rest, 32);
  if (rest.size() - kEntryBytes < name + extra + comment) fail(zip, "an entry is damaged");
  ZipMember member{
      .name = {reinterpret_cast<const char*>(rest.data()) + kEntryBytes, name},
      .deflated = little<std::uint16_t>(rest, 10) == 8,
      .crc = little<std::uint32_t>(rest, 16),
      .packed_bytes = little<std::uint32_t>(rest, 20),
      .bytes = little<std::uint32_t>(rest, 24),
      .header = little<std::uint32_t>(rest, 42),
  };
  take_zip64(zip, rest.subspan(kEntryBytes + name, extra), member);
  rest = rest.subspan(kEntryBytes + name + extra + comment);
  return member;
}

}  // namespace

bool has_zip_magic(std::span<const std::byte> head) {
  if (head.size() < 4) return false;
  const auto magic = little<std::uint32_t>(head, 0);
  return magic == kLocalHeader || magic == kEnd;
}

std::vector<ZipMember> read_zip_directory(const ByteSource& zip) {
  if (zip.size() < kEndBytes) fail(zip, text("the file has only ", zip.size(), " bytes"));
  const Directory directory = find_directory(zip);
  if (directory.bytes > kMaxDirectoryBytes) {
    fail(zip, text("its length of ", directory.bytes, " bytes is not credible"));
  }
  const auto bytes = read_bytes(zip, directory.offset, static_cast<std::size_t>(directory.bytes));
  std::vector<ZipMember> members;
  for (std::span<const std::byte> rest(bytes); !rest.empty();) {
    members.push_back(take_entry(zip, rest));
  }
  return members;
}

std::uint64_t zip_data_offset(const ByteSource& zip, const ZipMember& member) {
  const std::string field = text("zip member '", member.name, "'");
  const auto header = read_bytes(zip, member.header, kLocalBytes);
  if (little<std::uint32_t>(header, 0) != kLocalHeader) {
    fail_input(zip.name(), field, "its header is not where the directory says",
               "the file is truncated or damaged");
  }
  const auto flags = little<std::uint16_t>(header, 6);
  const auto method = little<std::uint16_t>(header, 8);
  if ((flags & 1U) != 0) fail_input(zip.name(), field, "is encrypted", "save without a password");
  if (method != (member.deflated ? 8 : 0)) {
    fail_input(zip.name(), field, text("compression method ", method, " is not supported"),
               "save with numpy.savez or numpy.savez_compressed");
  }
  const std::uint64_t offset = member.header + kLocalBytes + little<std::uint16_t>(header, 26) +
                               little<std::uint16_t>(header, 28);
  if (offset > zip.size() || member.packed_bytes > zip.size() - offset) {
    fail_input(zip.name(), field,
               text("needs ", member.packed_bytes, " bytes at offset ", offset,
                    ", the file ends at ", zip.size()),
               "the file is truncated or damaged");
  }
  return offset;
}

void check_zip_crc(const ByteSource& unpacked, const ZipMember& member) {
  std::vector<std::byte> buffer(
      static_cast<std::size_t>(std::min<std::uint64_t>(unpacked.size(), 1 << 20)));
  uLong crc = 0;
  for (std::uint64_t at = 0; at < unpacked.size(); at += buffer.size()) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), unpacked.size() - at));
    unpacked.read_at(at, std::span(buffer).first(count));
    crc = crc32_z(crc, reinterpret_cast<const Bytef*>(buffer.data()), count);
  }
  if (crc == member.crc) return;
  fail_input(unpacked.name(), {}, "its bytes are not those whose checksum the archive has",
             "get a whole copy of the file");
}

}  // namespace mw::io
