// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Inflates from front to back into a temporary file, piece by piece.
#include "io/file/inflated_source.h"

#include <algorithm>
#include <limits>

#include "io/file/errors.h"
#include "io/file/open_bytes.h"

namespace mw::io {
namespace {

constexpr std::size_t kPieceBytes = 1 << 18;

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

/// Or to the end.
void InflatedSource::unpack_to(std::uint64_t size) const {
  if (size <= unpacked_) return;
  const std::lock_guard lock(mutex_);
  std::vector<std::byte> piece(inflater_ ? kPieceBytes : 0);
  while (inflater_ && unpacked_ < size) {
    const std::size_t count = inflater_->read(piece);
    is_too_large_ = is_too_large_ || count > max_ - unpacked_;
    if (is_too_large_) fail_too_large(name(), max_);
    file_.write_at(unpacked_, std::span(piece).first(count));
    unpacked_ += count;
    if (count < piece.size()) inflater_.reset();
  }
}

}  // namespace mw::io
