// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files in a ZIP archive, stored or deflated.
#include "io/store/zip_store.h"

#include <zlib.h>

#include <array>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/store/held_bytes.h"
#include "io/store/zip_directory.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kHeldBytes = 4ULL << 20U;
constexpr std::uint16_t kStoredMember = 0, kDeflatedMember = 8;

/// What is unpacked, with its checksum: in memory if it is little, else in a file.
class Unpacked {
 public:
  explicit Unpacked(std::uint64_t size) {
    if (size > kHeldBytes) file_.emplace(scratch_folder());
  }
  void append(std::span<const std::byte> bytes) {
    crc_ =
        crc32(crc_, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
    size_ += bytes.size();
    if (file_) return file_->append(bytes);
    held_.insert(held_.end(), bytes.begin(), bytes.end());
  }
  [[nodiscard]] uLong crc() const { return crc_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::unique_ptr<ByteSource> source(const std::string& name) {
    if (!file_) return std::make_unique<HeldBytes>(std::move(held_), name);
    return std::make_unique<FileSource>(file_->release(), size_, name);
  }

 private:
  std::optional<ScratchFile> file_;
  std::vector<std::byte> held_;
  std::uint64_t size_ = 0;
  uLong crc_ = crc32(0, nullptr, 0);
};

class ZipStore : public Store {
 public:
  explicit ZipStore(std::shared_ptr<const ByteSource> archive)
      : archive_(std::move(archive)), directory_(*archive_) {}

  [[nodiscard]] std::unique_ptr<ByteSource> open(const std::string& name,
                                                 std::uint64_t max) const override {
    const ZipMember* member = directory_.find(inner(name));
    if (member == nullptr) return nullptr;
    if (member->size > max) {
      fail_input(name, {}, text("has ", member->size, " bytes, ", max, " at most are expected"),
                 "the archive is damaged");
    }
    return open_member(*member, name);
  }
  [[nodiscard]] std::unique_ptr<ByteSource> open_parts(const std::string& name) const override {
    const ZipMember* member = directory_.find(inner(name));
    return member == nullptr ? nullptr : open_member(*member, name);
  }
  [[nodiscard]] std::shared_ptr<const ByteSource> open_part(const std::string& name,
                                                            std::uint64_t offset,
                                                            std::uint64_t size,
                                                            std::string label) const override {
    std::shared_ptr<const ByteSource> whole = open_parts(name);
    if (whole == nullptr) fail_input(name, {}, "is not in the archive", "get a whole copy of it");
    if (offset > whole->size() || size > whole->size() - offset) {
      fail_input(label, {},
                 text("expected ", size, " bytes at offset ", offset, " of ", whole->size()),
                 "get a whole copy of the archive");
    }
    return std::make_shared<BytesPart>(std::move(whole), offset, size, std::move(label));
  }
  [[nodiscard]] std::uint64_t held_bytes(std::uint64_t max) const override {
    return std::min(max, kHeldBytes);
  }
  [[nodiscard]] bool has_file(const std::string& name) const override {
    return directory_.find(inner(name)) != nullptr;
  }
  [[nodiscard]] std::optional<bool> has_folder(const std::string& name) const override {
    return directory_.has_folder(inner(name));
  }
  [[nodiscard]] std::optional<std::vector<std::string>> folders_in(
      const std::string& name) const override {
    return directory_.folders_in(inner(name));
  }
  [[nodiscard]] bool is_near() const override { return true; }
  [[nodiscard]] std::string below(const std::string& name, std::string_view more) const override {
    return text(name, "/", more);
  }
  [[nodiscard]] std::optional<std::pair<std::string, std::string>> above(
      const std::string& name) const override {
    if (inner(name).empty()) return std::nullopt;
    const std::size_t slash = name.rfind('/');
    return std::pair(name.substr(0, slash), name.substr(slash + 1));
  }

 private:
  /// Returns the name of a place in the archive; "" for the archive itself.
  [[nodiscard]] std::string_view inner(std::string_view name) const {
    name.remove_prefix(std::min(archive_->name().size(), name.size()));
    if (name.starts_with('/')) name.remove_prefix(1);
    return name;
  }

  /// Returns where the bytes of a file begin, behind its local header and the name there.
  [[nodiscard]] std::uint64_t first_byte(const ZipMember& member, const std::string& name) const {
    constexpr std::size_t kHeaderBytes = 30;
    constexpr std::array kMark{std::byte{'P'}, std::byte{'K'}, std::byte{3}, std::byte{4}};
    const std::uint64_t size = archive_->size();
    std::array<std::byte, kHeaderBytes> header{};
    const bool is_inside = member.header <= size && size - member.header >= kHeaderBytes;
    if (is_inside) archive_->read_at(member.header, header);
    const auto length = [&](std::size_t at) {
      return load<std::uint16_t>(&header[at], ByteOrder::kLittle);
    };
    const std::uint64_t first = member.header + kHeaderBytes + length(26) + length(28);
    if (!is_inside || !std::equal(kMark.begin(), kMark.end(), header.begin()) || first > size ||
        member.packed > size - first) {
      fail_input(name, "ZIP header", "missing or damaged", "get a whole copy of the archive");
    }
    return first;
  }

  [[nodiscard]] std::unique_ptr<ByteSource> open_member(const ZipMember& member,
                                                        const std::string& name) const {
    if (member.is_encrypted ||
        (member.method != kStoredMember && member.method != kDeflatedMember)) {
      fail_input(name, {},
                 member.is_encrypted ? std::string("is encrypted")
                                     : text("is packed by method ", member.method, " of ZIP"),
                 "store or deflate the files of the archive");
    }
    const std::uint64_t first = first_byte(member, name);
    if (member.method == kDeflatedMember) return inflated(member, first, name);
    if (member.size != member.packed) {
      fail_input(name, "ZIP directory", "two sizes of a stored file", "the archive is damaged");
    }
    return std::make_unique<BytesPart>(archive_, first, member.size, name);
  }

  [[nodiscard]] std::unique_ptr<ByteSource> inflated(const ZipMember& member, std::uint64_t first,
                                                     const std::string& name) const {
    constexpr std::uint64_t kPiece = 1 << 18;
    const auto fail = [&](std::string_view reason) {
      fail_input(name, "deflated data", reason, "get a whole copy of the archive");
    };
    if (!can_inflate_to(member.packed, member.size)) fail("cannot unpack to the size of the file");
    const BytesPart packed(archive_, first, member.packed, name);
    Inflater inflater(
        packed, {.end = member.packed, .framing = DeflateFraming::kBare, .field = "deflated data"});
    Unpacked out(member.size);
    std::vector<std::byte> piece(std::min(kPiece, member.size + 1));
    for (std::size_t count = inflater.read(piece); count > 0; count = inflater.read(piece)) {
      if (count > member.size - out.size()) fail("unpacks to more than the size of the file");
      out.append(std::span(piece).first(count));
    }
    if (out.size() != member.size || out.crc() != member.crc) fail("its checksum differs");
    return out.source(name);
  }

  std::shared_ptr<const ByteSource> archive_;
  ZipDirectory directory_;
};

}  // namespace

Place zip_place(std::shared_ptr<const ByteSource> archive) {
  const std::string name = archive->name();
  return {std::make_shared<const ZipStore>(std::move(archive)), name};
}

}  // namespace mw::io
