// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files for reading by region; inflates gzip into a temporary file.
#include "io/file/open_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/file/scratch_file.h"

namespace mw::io {
namespace {

constexpr std::size_t kChunkBytes = 1 << 18;
constexpr int kGzipOnly = 15 + 16;  // zlib's window bits: largest window, gzip wrapper

/// zlib's state for a chain of gzip members, fed from a ByteSource.
class Inflater {
 public:
  Inflater(const ByteSource& packed, std::uint64_t offset) : packed_(packed), next_(offset) {
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) {
      throw Error(ErrorKind::kResource, packed.name() + ": no memory to inflate it");
    }
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Inflates into out; the number of bytes, less than out.size() only at the end.
  std::size_t read(std::span<std::byte> out) {
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = static_cast<uInt>(out.size());
    while (stream_.avail_out > 0 && !done_) step();
    return out.size() - stream_.avail_out;
  }

 private:
  void step() {
    if (stream_.avail_in == 0) refill();
    const int verdict = inflate(&stream_, Z_NO_FLUSH);
    if (verdict == Z_STREAM_END) {
      start_next_member();
    } else if (verdict == Z_BUF_ERROR && stream_.avail_in == 0) {
      return;  // wants more input; refill tells whether there is any
    } else if (verdict != Z_OK) {
      const char* reason = stream_.msg != nullptr ? stream_.msg : "damaged";
      fail_input(packed_.name(), "gzip data",
                 std::string("corrupt near offset ") + std::to_string(next_ - stream_.avail_in) +
                     " (" + reason + ")",
                 "get a whole copy of the file");
    }
  }

  void refill() {
    const std::uint64_t left = packed_.size() - next_;
    if (left == 0) {
      fail_input(packed_.name(), "gzip data",
                 "truncated: the file ends at " + std::to_string(next_) + " inside a gzip member",
                 "get a whole copy of the file");
    }
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, kChunkBytes));
    packed_.read_at(next_, std::span(buffer_).first(count));
    next_ += count;
    stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
    stream_.avail_in = static_cast<uInt>(count);
  }

  /// Members may be chained; what follows the last and is no member is padding, as for gunzip.
  void start_next_member() {
    const std::uint64_t position = next_ - stream_.avail_in;
    done_ = !is_gzip(packed_, position);
    if (!done_) inflateReset(&stream_);
  }

  const ByteSource& packed_;
  std::uint64_t next_;
  z_stream stream_{};
  bool done_ = false;
  std::vector<std::byte> buffer_ = std::vector<std::byte>(kChunkBytes);
};

}  // namespace

bool is_gzip(const ByteSource& source, std::uint64_t offset) {
  std::array<std::byte, 3> magic;
  if (source.size() < offset || source.size() - offset < magic.size()) return false;
  source.read_at(offset, magic);
  return magic == std::array{std::byte{0x1f}, std::byte{0x8b}, std::byte{8}};
}

std::unique_ptr<ByteSource> inflate_bytes(const ByteSource& packed, std::uint64_t offset) {
  if (!is_gzip(packed, offset)) {
    fail_input(packed.name(), "gzip data", "no gzip data at offset " + std::to_string(offset));
  }
  ScratchFile scratch(scratch_folder());
  Inflater inflater(packed, offset);
  std::vector<std::byte> buffer(kChunkBytes);
  while (const std::size_t count = inflater.read(buffer)) {
    scratch.append(std::span(buffer).first(count));
  }
  const std::uint64_t total = scratch.size();
  return std::make_unique<FileSource>(scratch.release(), total, packed.name());
}

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path) {
  auto file = std::make_unique<FileSource>(path);
  if (file->size() == 0) fail_input(file->name(), {}, "the file is empty", "check how it was made");
  if (is_gzip(*file)) return inflate_bytes(*file, 0);
  return file;
}

}  // namespace mw::io
