// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A source that is inflated into a temporary file, as far as it is asked for.
#include "io/file/source/inflated_source.h"

#include <algorithm>
#include <array>
#include <limits>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"

namespace mw::io {
namespace {

[[noreturn]] void fail_too_large(const std::string& name, std::uint64_t max) {
  throw Error(ErrorKind::kResource,
              text(name, ": gzip data: unpacks to more than ", max, " bytes, what ",
                   scratch_folder().string(),
                   " has room for; set TMPDIR to a folder on a larger disk, or gunzip it there"));
}

}  // namespace

std::uint64_t room_to_inflate() {
  std::error_code unknown;
  const std::uintmax_t free = std::filesystem::space(scratch_folder(), unknown).available;
  return unknown ? std::numeric_limits<std::uint64_t>::max() : free - free / 4;
}

InflatedSource::InflatedSource(std::unique_ptr<ByteSource> packed, std::uint64_t offset,
                               std::uint64_t max)
    : packed_(std::move(packed)), max_(max), file_(scratch_folder()) {
  if (!is_gzip(*packed_, offset)) {
    fail_input(packed_->name(), "gzip data", text("no gzip data at offset ", offset));
  }
  inflater_ =
      std::make_unique<Inflater>(*packed_, DeflatedBytes{.offset = offset, .end = packed_->size()});
}

std::uint64_t InflatedSource::size() const {
  return size_within(std::numeric_limits<std::uint64_t>::max());
}

std::uint64_t InflatedSource::size_within(std::uint64_t max) const {
  unpack_to(max);
  return std::min<std::uint64_t>(unpacked_, max);
}

void InflatedSource::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  const std::uint64_t size = size_within(saturating_sum(offset, out.size()));
  if (offset > size || out.size() > size - offset) {
    fail_input(name(), "gzip data",
               text("expected ", out.size(), " bytes at offset ", offset,
                    ", but unpacked it ends at ", size),
               "the file is truncated: get a whole copy");
  }
  file_.read_at(offset, out);
}

/// Unpacks up to `size` bytes, or to the end.
void InflatedSource::unpack_to(std::uint64_t size) const {
  if (size <= unpacked_) return;
  const std::lock_guard lock(mutex_);
  constexpr std::size_t kPiece = 1 << 18;
  std::vector<std::byte> piece(inflater_ ? kPiece : 0);
  while (inflater_ && unpacked_ < size) {
    const std::size_t count = inflater_->read(piece);
    is_too_large_ = is_too_large_ || count > max_ - unpacked_;
    if (is_too_large_) fail_too_large(name(), max_);
    file_.write_at(unpacked_, std::span(piece).first(count));
    unpacked_ += count;
    if (count < piece.size()) inflater_.reset();
  }
}

bool is_gzip(const ByteSource& source, std::uint64_t offset) {
  std::array<std::byte, 3> magic;
  const std::uint64_t end = offset + magic.size();
  if (end < offset || source.size_within(end) < end) return false;
  source.read_at(offset, magic);
  return magic == std::array{std::byte{0x1f}, std::byte{0x8b}, std::byte{8}};
}

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path) {
  auto file = std::make_unique<FileSource>(path);
  if (file->size() == 0) fail_input(file->name(), {}, "the file is empty", "check how it was made");
  if (is_gzip(*file)) return std::make_unique<InflatedSource>(std::move(file), 0);
  return file;
}

}  // namespace mw::io
