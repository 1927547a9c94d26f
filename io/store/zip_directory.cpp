// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the central directory of a ZIP archive.
#include "io/store/zip_directory.h"

#include <algorithm>
#include <cstring>

#include "io/file/byte_order.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::string_view kEndMark("PK\5\6", 4), kEnd64Mark("PK\6\6", 4),
    kLocatorMark("PK\6\7", 4), kRowMark("PK\1\2", 4);
constexpr std::size_t kEndBytes = 22, kEnd64Bytes = 56, kLocatorBytes = 20, kRowBytes = 46;
constexpr std::uint64_t kMaxComment = 65535;
constexpr std::uint64_t kMaxDirectoryBytes = std::uint64_t{1} << 30U;
constexpr std::uint16_t kZip64Field = 1;

[[noreturn]] void fail_damaged(const std::string& file, std::string_view reason) {
  fail_input(file, "ZIP directory", reason, "get a whole copy of the archive");
}

template <class T>
T number(std::string_view bytes, std::size_t at) {
  return load<T>(reinterpret_cast<const std::byte*>(bytes.data()) + at, ByteOrder::kLittle);
}

std::string read_text(const ByteSource& archive, std::uint64_t at, std::uint64_t size) {
  std::string out(size, '\0');
  archive.read_at(at, std::as_writable_bytes(std::span(out)));
  return out;
}

/// Where the directory is.
struct Extent {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::uint64_t count = 0;
};

/// Reads the record of archives with numbers of 64 bits, to which a locator in front of the end
/// points.
std::optional<Extent> large_extent(const ByteSource& archive, std::uint64_t end) {
  if (end < kLocatorBytes) return std::nullopt;
  const std::string locator = read_text(archive, end - kLocatorBytes, kLocatorBytes);
  if (!locator.starts_with(kLocatorMark)) return std::nullopt;
  const auto at = number<std::uint64_t>(locator, 8);
  if (end < kEnd64Bytes || at > end - kEnd64Bytes) {
    fail_damaged(archive.name(), "its end lies outside of the file");
  }
  const std::string record = read_text(archive, at, kEnd64Bytes);
  if (!record.starts_with(kEnd64Mark)) fail_damaged(archive.name(), "its end is damaged");
  return Extent{.offset = number<std::uint64_t>(record, 48),
                .bytes = number<std::uint64_t>(record, 40),
                .count = number<std::uint64_t>(record, 32)};
}

/// Returns where the record at the end begins in the last bytes of an archive: a comment follows
/// it, which is as long as it says, and may have the record's mark in it, too.
std::size_t find_end(const std::string& tail) {
  if (tail.size() < kEndBytes) return tail.npos;
  std::size_t at = tail.rfind(kEndMark, tail.size() - kEndBytes);
  while (at != tail.npos) {
    if (at + kEndBytes + number<std::uint16_t>(tail, at + 20) == tail.size()) return at;
    at = at == 0 ? tail.npos : tail.rfind(kEndMark, at - 1);
  }
  return tail.npos;
}

Extent find_directory(const ByteSource& archive) {
  const std::uint64_t size = archive.size();
  const std::uint64_t tail_bytes = std::min(size, kEndBytes + kMaxComment);
  const std::string tail = read_text(archive, size - tail_bytes, tail_bytes);
  const std::size_t at = find_end(tail);
  if (at == tail.npos) fail_damaged(archive.name(), "its end was not found");
  const std::uint64_t end = size - tail_bytes + at;
  const std::string_view record = std::string_view(tail).substr(at);
  Extent out{.offset = number<std::uint32_t>(record, 16),
             .bytes = number<std::uint32_t>(record, 12),
             .count = number<std::uint16_t>(record, 10)};
  if (const auto large = large_extent(archive, end)) out = *large;
  if (out.offset > size || out.bytes > size - out.offset || out.bytes > kMaxDirectoryBytes ||
      out.count > out.bytes / kRowBytes) {
    fail_damaged(archive.name(), "it lies outside of the file, or is not credible");
  }
  return out;
}

/// Takes the numbers of 64 bits that stand for those of 32 which are all ones.
void read_large_numbers(std::string_view extra, ZipMember& member) {
  constexpr std::uint64_t kElsewhere = 0xffffffff;
  while (extra.size() >= 4) {
    const auto id = number<std::uint16_t>(extra, 0), length = number<std::uint16_t>(extra, 2);
    std::string_view field = extra.substr(4, length);
    extra.remove_prefix(std::min<std::size_t>(extra.size(), 4U + length));
    if (id != kZip64Field) continue;
    for (std::uint64_t* value : {&member.size, &member.packed, &member.header}) {
      if (*value != kElsewhere || field.size() < 8) continue;
      *value = number<std::uint64_t>(field, 0);
      field.remove_prefix(8);
    }
  }
}

}  // namespace

bool has_zip_magic(std::span<const std::byte> head) {
  return head.size() >= 4 && (std::memcmp(head.data(), "PK\3\4", 4) == 0 ||
                              std::memcmp(head.data(), kEndMark.data(), 4) == 0);
}

ZipDirectory::ZipDirectory(const ByteSource& archive) {
  const Extent extent = find_directory(archive);
  read_rows(read_text(archive, extent.offset, extent.bytes), extent.count, archive.name());
  sort_rows();
}

void ZipDirectory::read_rows(const std::string& directory, std::uint64_t count,
                             const std::string& file) {
  std::string_view left = directory;
  rows_.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (left.size() < kRowBytes || !left.starts_with(kRowMark)) {
      fail_damaged(file, text("row ", i + 1, " of ", count, " is damaged"));
    }
    const auto name = number<std::uint16_t>(left, 28), extra = number<std::uint16_t>(left, 30);
    const std::size_t bytes = kRowBytes + name + extra + number<std::uint16_t>(left, 32);
    if (left.size() < bytes) fail_damaged(file, text("row ", i + 1, " of ", count, " is cut"));
    ZipMember member{.header = number<std::uint32_t>(left, 42),
                     .packed = number<std::uint32_t>(left, 20),
                     .size = number<std::uint32_t>(left, 24),
                     .crc = number<std::uint32_t>(left, 16),
                     .method = number<std::uint16_t>(left, 10),
                     .is_encrypted = (number<std::uint16_t>(left, 8) & 1U) != 0};
    read_large_numbers(left.substr(kRowBytes + name, extra), member);
    rows_.push_back({.name = names_.size(), .length = name, .member = member});
    names_ += left.substr(kRowBytes, name);
    left.remove_prefix(bytes);
  }
}

void ZipDirectory::sort_rows() {
  const auto comes_before = [&](const Row& a, const Row& b) { return name_of(a) < name_of(b); };
  std::stable_sort(rows_.begin(), rows_.end(), comes_before);
  // Of rows of one name the last in the archive stays.
  const auto end = std::unique(rows_.rbegin(), rows_.rend(), [&](const Row& a, const Row& b) {
    return name_of(a) == name_of(b);
  });
  rows_.erase(rows_.begin(), end.base());
}

std::vector<ZipDirectory::Row>::const_iterator ZipDirectory::lower_bound(
    std::string_view name) const {
  return std::partition_point(rows_.begin(), rows_.end(),
                              [&](const Row& row) { return name_of(row) < name; });
}

const ZipMember* ZipDirectory::find(std::string_view name) const {
  const auto row = lower_bound(name);
  return row != rows_.end() && name_of(*row) == name ? &row->member : nullptr;
}

bool ZipDirectory::has_folder(std::string_view folder) const {
  if (folder.empty()) return true;
  const std::string prefix = std::string(folder) + "/";
  const auto row = lower_bound(prefix);
  return row != rows_.end() && name_of(*row).starts_with(prefix);
}

std::vector<std::string> ZipDirectory::folders_in(std::string_view folder) const {
  constexpr char kBehindSlash = '/' + 1;
  const std::string prefix = folder.empty() ? "" : std::string(folder) + "/";
  std::vector<std::string> out;
  for (auto row = lower_bound(prefix); row != rows_.end();) {
    const std::string_view name = name_of(*row);
    if (!name.starts_with(prefix)) break;
    const std::size_t slash = name.find('/', prefix.size());
    if (slash == name.npos) {
      ++row;
      continue;
    }
    out.emplace_back(name.substr(prefix.size(), slash - prefix.size()));
    row = lower_bound(std::string(name.substr(0, slash)) + kBehindSlash);
  }
  return out;
}

}  // namespace mw::io
