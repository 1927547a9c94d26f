// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Inflates from front to back, piece by piece.
#include "io/file/source/inflated_source.h"

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"

namespace mw::io {
namespace {

constexpr std::size_t kChunkBytes = 1 << 18;

/// Returns zlib's "window bits", which give the largest window and the framing.
int window_bits(DeflateFraming framing) {
  constexpr int kWindow = 15;
  if (framing == DeflateFraming::kBare) return -kWindow;
  return kWindow + (framing == DeflateFraming::kGzipChain ? 16 : 32);
}

}  // namespace

bool can_inflate_to(std::uint64_t packed, std::uint64_t bytes) {
  constexpr std::uint64_t kMaxRatio = 1032;
  return bytes / kMaxRatio <= packed;
}

Inflater::Inflater(const ByteSource& packed, DeflatedBytes deflated)
    : packed_(packed),
      deflated_(std::move(deflated)),
      next_(deflated_.offset),
      buffer_(kChunkBytes) {
  if (inflateInit2(&stream_, window_bits(deflated_.framing)) != Z_OK) {
    throw Error(ErrorKind::kResource, packed.name() + ": no memory to inflate it");
  }
}

std::size_t Inflater::read(std::span<std::byte> out) {
  std::size_t count = 0;
  while (count < out.size() && !done_) {
    const std::size_t length = std::min(out.size() - count, kChunkBytes);
    stream_.next_out = reinterpret_cast<Bytef*>(out.data() + count);
    stream_.avail_out = static_cast<uInt>(length);
    while (stream_.avail_out > 0 && !done_) step();
    count += length - stream_.avail_out;
  }
  return count;
}

void Inflater::step() {
  if (stream_.avail_in == 0) refill();
  const int verdict = inflate(&stream_, Z_NO_FLUSH);
  if (verdict == Z_STREAM_END) {
    start_next_member();
  } else if (verdict == Z_BUF_ERROR && stream_.avail_in == 0) {
    return;  // it needs more input; refill() tells whether there is any
  } else if (verdict != Z_OK) {
    const char* reason = stream_.msg != nullptr ? stream_.msg : "damaged";
    fail_input(packed_.name(), deflated_.field,
               text("corrupt near offset ", next_ - stream_.avail_in, " (", reason, ")"),
               "get a whole copy of the file");
  }
}

void Inflater::refill() {
  const std::uint64_t left = deflated_.end - next_;
  if (left == 0) {
    fail_input(packed_.name(), deflated_.field,
               text("truncated: the packed bytes end at ", next_, ", more must follow"),
               "get a whole copy of the file");
  }
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, kChunkBytes));
  packed_.read_at(next_, std::span(buffer_).first(count));
  next_ += count;
  stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
  stream_.avail_in = static_cast<uInt>(count);
}

/// Goes on with a member that follows the one that ended.  Other bytes behind a member are padding,
/// as for gunzip.
void Inflater::start_next_member() {
  const std::uint64_t position = next_ - stream_.avail_in;
  done_ = deflated_.framing != DeflateFraming::kGzipChain || !is_gzip(packed_, position);
  if (!done_) inflateReset(&stream_);
}

std::unique_ptr<ByteSource> inflate_to_scratch(const ByteSource& packed,
                                               const DeflatedBytes& deflated, std::uint64_t bytes) {
  const auto fail_short = [&](std::string_view reason) {
    fail_input(packed.name(), deflated.field, text(reason, ", ", bytes, " are needed"),
               "the file is truncated, or the shape or type is wrong");
  };
  if (!can_inflate_to(deflated.end - deflated.offset, bytes)) {
    fail_short(text(deflated.end - deflated.offset, " packed bytes cannot hold enough"));
  }
  ScratchFile scratch(scratch_folder());
  Inflater inflater(packed, deflated);
  std::vector<std::byte> buffer(std::min<std::uint64_t>(bytes, kChunkBytes));
  while (scratch.size() < bytes) {
    const auto wanted = std::min<std::uint64_t>(bytes - scratch.size(), buffer.size());
    const std::size_t count = inflater.read(std::span(buffer).first(wanted));
    scratch.append(std::span(buffer).first(count));
    if (count < wanted) fail_short(text("it ends after ", scratch.size(), " bytes"));
  }
  std::array<std::byte, 1> behind{};
  static_cast<void>(inflater.read(behind));  // at the end of the stream the checksum is compared
  return std::make_unique<FileSource>(scratch.release(), bytes, packed.name());
}

}  // namespace mw::io
