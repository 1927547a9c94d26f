// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The loop around libraries that unpack piece by piece.
#include "io/codec/stream.h"

#include <algorithm>
#include <string>

#include "io/codec/codec.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"

namespace mw::io {

void fail_packed(const PackedName& name, std::string_view reason) {
  fail_input(name.file, name.codec, reason, "get a whole copy of the store");
}

void fail_too_much(const PackedName& name, std::size_t max) {
  fail_packed(name, text("unpacks to more than the ", max, " bytes that it should hold"));
}

void fail_no_memory(const PackedName& name) {
  throw Error(ErrorKind::kResource, text(name.file, ": ", name.codec, ": no memory to unpack it"));
}

namespace {

constexpr std::size_t kPieceBytes = 1 << 20;

bool is_padding(std::span<const std::byte> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; });
}

/// Packed bytes in memory.
class HeldInput {
 public:
  explicit HeldInput(std::span<const std::byte> packed) : left_(packed) {}

  /// The bytes that come next; none at the end.
  [[nodiscard]] std::span<const std::byte> next() {
    return left_.first(std::min(left_.size(), kMaxStreamStep));
  }
  void took(std::size_t count) { left_ = left_.subspan(count); }
  /// Whether only zeros are left.
  [[nodiscard]] bool ends() const { return is_padding(left_); }

 private:
  std::span<const std::byte> left_;
};

/// Packed bytes of a source, a piece at a time.
class SourceInput {
 public:
  explicit SourceInput(const ByteSource& packed) : packed_(packed) {}

  [[nodiscard]] std::span<const std::byte> next() {
    if (at_ == piece_.size()) {
      loaded_ += piece_.size();
      at_ = 0;
      piece_ = piece_at(loaded_);
    }
    return std::span<const std::byte>(piece_).subspan(at_);
  }
  void took(std::size_t count) { at_ += count; }
  [[nodiscard]] bool ends() const {
    for (std::uint64_t at = loaded_ + at_; at < packed_.size(); at += kPieceBytes) {
      if (!is_padding(piece_at(at))) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] std::vector<std::byte> piece_at(std::uint64_t offset) const {
    std::vector<std::byte> bytes(std::min<std::uint64_t>(packed_.size() - offset, kPieceBytes));
    packed_.read_at(offset, bytes);
    return bytes;
  }

  const ByteSource& packed_;
  std::uint64_t loaded_ = 0;  ///< where the piece begins
  std::vector<std::byte> piece_;
  std::size_t at_ = 0;  ///< the place in the piece
};

/// Unpacked bytes in memory.  One byte more than allowed has room, so that too many are seen.
class HeldOutput {
 public:
  /// The address space is taken at once, so that nothing moves; memory comes as bytes are written.
  explicit HeldOutput(std::size_t max) : max_(max) { bytes_.reserve(max + 1); }

  [[nodiscard]] std::span<std::byte> room() {
    bytes_.resize(std::min(max_ + 1, count_ + kPieceBytes));
    return std::span(bytes_).subspan(count_);
  }
  void took(std::size_t count) { count_ += count; }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::vector<std::byte> take() {
    bytes_.resize(count_);
    return std::move(bytes_);
  }

 private:
  std::size_t max_;
  std::size_t count_ = 0;
  std::vector<std::byte> bytes_;
};

/// Unpacked bytes in a file.
class FileOutput {
 public:
  FileOutput() : file_(scratch_folder()), piece_(kPieceBytes) {}

  [[nodiscard]] std::span<std::byte> room() { return piece_; }
  void took(std::size_t count) { file_.append(std::span(piece_).first(count)); }
  [[nodiscard]] std::uint64_t count() const { return file_.size(); }
  [[nodiscard]] std::shared_ptr<const ByteSource> take(std::string name) {
    const std::uint64_t size = file_.size();
    return std::make_shared<FileSource>(file_.release(), size, std::move(name));
  }

 private:
  ScratchFile file_;
  std::vector<std::byte> piece_;
};

/// The arguments of a call beside its input and output.
struct Unpacking {
  StreamDecoder& decoder;
  std::uint64_t max;
  const PackedName& name;
};

template <class Input, class Output>
void unpack(const Unpacking& unpacking, Input& input, Output& output) {
  while (true) {
    const auto step = unpacking.decoder.step(input.next(), output.room());
    input.took(step.taken);
    output.took(step.given);
    if (step.wrong != nullptr) fail_packed(unpacking.name, step.wrong);
    if (output.count() > unpacking.max) fail_too_much(unpacking.name, unpacking.max);
    if (step.ended) {
      if (input.ends()) return;
      unpacking.decoder.restart();
    } else if (step.taken == 0 && step.given == 0) {
      fail_packed(unpacking.name, "truncated: the packed bytes end too early");
    }
  }
}

}  // namespace

std::vector<std::byte> unpack_streams(StreamDecoder& decoder, std::span<const std::byte> packed,
                                      std::size_t max, const PackedName& name) {
  HeldInput input(packed);
  HeldOutput output(max);
  unpack({decoder, max, name}, input, output);
  return output.take();
}

std::shared_ptr<const ByteSource> unpack_streams(StreamDecoder& decoder, const ByteSource& packed,
                                                 std::uint64_t max, const PackedName& name) {
  SourceInput input(packed);
  FileOutput output;
  unpack({decoder, max, name}, input, output);
  return output.take(std::string(name.file));
}

std::unique_ptr<StreamDecoder> stream_decoder(Codec codec, const PackedName& name) {
  switch (codec) {
    case Codec::kGzip:
      return gzip_decoder(name);
    case Codec::kZlib:
      return zlib_decoder(name);
    case Codec::kBzip2:
      return bzip2_decoder(name);
    case Codec::kXz:
      return xz_decoder(name);
    case Codec::kZstd:
      return zstd_decoder(name);
    default:
      return nullptr;
  }
}

}  // namespace mw::io
